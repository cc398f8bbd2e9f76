#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/finishing/fewer_triangles.hpp>
#include <turnscan/reconstruction/mesh_refinement/simplify_within.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>

namespace turnscan::finishing {

namespace {

/// Errors of the surface, e, and of its triangles, d (root mean square), are independent: F falls
/// by at most 0.242 (d / e)^2, at a threshold of e. d is about half of the bound of the quadrics, e
/// / 16, which costs less than 0.001.
constexpr double kShareOfError = 0.125;
/// Correct detail is not finer than this, however large the error of the whole may be.
constexpr double kShareOfVoxel = 0.25;
/// Where the error is not known, as from points: their heights are fitted to this (point_stages).
constexpr double kShareOfVoxelFitted = 0.05;
constexpr double kFarthestVoxels = 0.5;

struct Bound {
  std::size_t triangles = 0;
  double error_m = 0.0;     ///< bound on the quadrics; 0: only the number counts
  double farthest_m = 0.0;  ///< of any vertex of the full mesh
  std::string reason;
};

/// Median over the measured vertices; nullopt: not known.
std::optional<double> expected_error(const ObjectResult& object) {
  const std::vector<std::uint8_t> measured = measured_vertices(object);
  std::vector<float> errors;
  for (std::size_t v = 0; v < object.quality.size(); ++v)
    if (measured[v]) errors.push_back(object.quality[v].expected_error_m);
  if (errors.empty()) return std::nullopt;
  return median(errors);
}

Bound worth_of(const ObjectResult& object, double voxel_m) {
  const double coarsest_m = kShareOfVoxel * voxel_m, farthest_m = kFarthestVoxels * voxel_m;
  const std::optional<double> error_m = expected_error(object);
  if (!error_m)
    return {0, kShareOfVoxelFitted * voxel_m, farthest_m,
            fmt::format("to a twentieth of a voxel of {:.2g} mm", voxel_m * 1e3)};
  if (kShareOfError * *error_m > coarsest_m)
    return {0, coarsest_m, farthest_m,
            fmt::format("to a quarter of a voxel of {:.2g} mm", voxel_m * 1e3)};
  return {
      0, kShareOfError * *error_m, farthest_m,
      fmt::format("to an eighth of the expected error, {:.2g} mm in the median", *error_m * 1e3)};
}

Bound bound_for(const ReconstructOptions& options, std::optional<std::size_t> wanted,
                const ObjectResult& object, double voxel_m) {
  const std::optional<double>& max_error_m = options.finish.max_error_m;
  if (max_error_m) return {wanted.value_or(0), *max_error_m, *max_error_m, "to max-error, given"};
  if (wanted) return {*wanted, 0.0, 0.0, "given"};
  if (options.color && !object.mesh.colors.empty())
    return {kAllTriangles, 0.0, 0.0, "its vertices carry the colours"};
  return worth_of(object, voxel_m);
}

/// Per vertex: a bit for each kind of evidence around it.
std::vector<std::uint8_t> kinds_of_evidence(const ObjectResult& object) {
  std::vector<std::uint8_t> out(object.mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    for (const std::uint32_t v : object.mesh.triangles[t])
      out[v] |= std::uint8_t(1u << unsigned(object.evidence[t]));
  return out;
}

/// The triangles around vertices where different kinds of evidence meet, one flag each.
std::vector<std::uint8_t> evidence_borders(const ObjectResult& object) {
  const auto& triangles = object.mesh.triangles;
  const std::vector<std::uint8_t> kinds = kinds_of_evidence(object);
  std::vector<std::uint8_t> out(triangles.size(), 0);
  for (std::size_t t = 0; t < out.size(); ++t)
    out[t] = std::any_of(triangles[t].begin(), triangles[t].end(),
                         [&](std::uint32_t v) { return std::popcount(kinds[v]) > 1; });
  return out;
}

using mesh_refinement::SimplifiedMesh;

Result<SimplifiedMesh> simplified(const ObjectResult& object, const Bound& bound,
                                  const RunContext& context) {
  if (bound.error_m > 0.0)
    return mesh_refinement::simplify_within(
        object.mesh, {bound.triangles, bound.error_m, evidence_borders(object)}, bound.farthest_m,
        context);
  TURNSCAN_ASSIGN(TriangleMesh fewer, simplify(object.mesh, {bound.triangles}));
  SimplifiedMesh out{std::move(fewer), std::vector<MeshDistance::Hit>(object.mesh.vertices.size())};
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(out.mesh, context));
  TURNSCAN_TRY(parallel_for(out.nearest.size(), 256, context, [&](std::size_t v) {
    out.nearest[v] = distance.closest(object.mesh.vertices[v].cast<double>());
  }));
  return out;
}

/// For each vertex of a simplified mesh the vertex of the full mesh at its position; for one that
/// mending added, a nearest corner of the triangle that it is on.
std::vector<std::uint32_t> places_in(const TriangleMesh& full, const TriangleMesh& fewer) {
  using Place = std::array<float, 3>;
  const auto place = [](const Vec3f& p) { return Place{p.x(), p.y(), p.z()}; };
  std::vector<std::pair<Place, std::uint32_t>> sorted;
  for (std::uint32_t v = 0; v < full.vertices.size(); ++v)
    sorted.emplace_back(place(full.vertices[v]), v);
  std::sort(sorted.begin(), sorted.end());
  std::optional<MeshDistance> on_full;
  const auto nearest = [&](const Vec3f& p) {
    if (!on_full) on_full.emplace(full);
    const auto& corners = full.triangles[on_full->closest(p.cast<double>()).triangle];
    return *std::min_element(corners.begin(), corners.end(), [&](auto a, auto b) {
      return (full.vertices[a] - p).squaredNorm() < (full.vertices[b] - p).squaredNorm();
    });
  };
  std::vector<std::uint32_t> out;
  for (const Vec3f& p : fewer.vertices) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), std::pair(place(p), 0u));
    out.push_back(at != sorted.end() && at->first == place(p) ? at->second : nearest(p));
  }
  return out;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> out(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) out[v] += triangle_area(mesh, t) / 3.0;
  return out;
}

/// Barycentric coordinates of a point on a triangle.
Vec3d barycentric(const TriangleMesh& mesh, std::size_t triangle, const Vec3d& p) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3d pa = mesh.vertices[a].cast<double>() - p, pb = mesh.vertices[b].cast<double>() - p,
              pc = mesh.vertices[c].cast<double>() - p;
  const Vec3d areas(pb.cross(pc).norm(), pc.cross(pa).norm(), pa.cross(pb).norm());
  return areas.sum() > 0.0 ? Vec3d(areas / areas.sum()) : Vec3d::Constant(1.0 / 3.0);
}

/// Sums over the surface around a vertex, weighted by area.
struct QualitySum {
  double area = 0.0, squares = 0.0, frames = 0.0, directions = 0.0;

  void add(const VertexQuality& q, double weight) {
    area += weight;
    squares += weight * double(q.expected_error_m) * double(q.expected_error_m);
    frames += weight * q.frames;
    directions += weight * q.directions;
  }
  VertexQuality mean() const {
    return {float(std::sqrt(squares / area)), std::uint16_t(std::lround(frames / area)),
            std::uint8_t(std::lround(directions / area))};
  }
};

/// Each vertex of the full mesh contributes to the corners of the triangle that contains it, unless
/// exactly one of them was measured.
std::vector<VertexQuality> carry_quality(const ObjectResult& full, const SimplifiedMesh& fewer,
                                         const std::vector<std::uint32_t>& place) {
  const std::vector<std::uint8_t> measured = measured_vertices(full);
  const std::vector<double> areas = vertex_areas(full.mesh);
  std::vector<QualitySum> sums(fewer.mesh.vertices.size());
  for (std::size_t v = 0; v < fewer.nearest.size(); ++v) {
    const MeshDistance::Hit& hit = fewer.nearest[v];
    const Vec3d shares = barycentric(fewer.mesh, hit.triangle, hit.point);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = fewer.mesh.triangles[hit.triangle][k];
      if (measured[place[corner]] == measured[v])
        sums[corner].add(full.quality[v], areas[v] * shares[Eigen::Index(k)]);
    }
  }
  std::vector<VertexQuality> out;
  for (std::size_t v = 0; v < sums.size(); ++v)
    out.push_back(sums[v].area > 0.0 ? sums[v].mean() : full.quality[place[v]]);
  return out;
}

/// The kind of evidence that surrounds all corners; of a triangle between several kinds that of the
/// full mesh's, or, where that is gone, the one that promises least.
std::vector<Evidence> carry_evidence(const ObjectResult& full, const TriangleMesh& fewer,
                                     const std::vector<std::uint32_t>& place) {
  const std::vector<std::uint8_t> kinds = kinds_of_evidence(full);
  const auto common = [&](const auto& t) {
    return unsigned(kinds[t[0]] & kinds[t[1]] & kinds[t[2]]);
  };
  const auto turned = [](std::array<std::uint32_t, 3> t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::map<std::array<std::uint32_t, 3>, Evidence> between;
  for (std::size_t t = 0; t < full.evidence.size(); ++t)
    if (std::popcount(common(full.mesh.triangles[t])) > 1)
      between.emplace(turned(full.mesh.triangles[t]), full.evidence[t]);
  std::vector<Evidence> out;
  for (const auto& [a, b, c] : fewer.triangles) {
    const std::array<std::uint32_t, 3> t{place[a], place[b], place[c]};
    const unsigned at = common(t);
    const auto same = std::popcount(at) > 1 ? between.find(turned(t)) : between.end();
    if (same != between.end())
      out.push_back(same->second);
    else if (std::popcount(at) == 1)
      out.push_back(Evidence(std::countr_zero(at)));
    else
      out.push_back(Evidence::kInvented);
  }
  return out;
}

/// Moves the mesh into the object, with its attributes.
void take(SimplifiedMesh fewer, ObjectResult& object) {
  const std::vector<std::uint32_t> place = places_in(object.mesh, fewer.mesh);
  if (!object.quality.empty()) object.quality = carry_quality(object, fewer, place);
  if (!object.confidence.empty()) {
    std::vector<float> confidence;
    for (const std::uint32_t v : place) confidence.push_back(object.confidence[v]);
    object.confidence = std::move(confidence);
  }
  const bool known = !object.evidence.empty();
  if (known) object.evidence = carry_evidence(object, fewer.mesh, place);
  object.mesh = std::move(fewer.mesh);
  object.check = check_mesh(object.mesh);
  if (!known) return;
  object.invented_area_m2 = 0.0;
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] == Evidence::kInvented)
      object.invented_area_m2 += triangle_area(object.mesh, t);
}

Result<> reduce_object(const Bound& bound, ObjectResult& object, const RunContext& context) {
  if (object.mesh.triangles.size() <= std::max<std::size_t>(4, bound.triangles)) return {};
  TURNSCAN_ASSIGN(SimplifiedMesh fewer, simplified(object, bound, context));
  if (fewer.mesh.triangles.size() < object.mesh.triangles.size()) take(std::move(fewer), object);
  return {};
}

}  // namespace

Result<> reduce_triangles(const ReconstructOptions& options, Reconstruction& reconstruction,
                          const RunContext& context) {
  TURNSCAN_ASSIGN(const auto wanted, triangles_wanted(options.finish.triangles));
  if (options.for_placing || (wanted == kAllTriangles && !options.finish.max_error_m)) return {};
  const StageTimer timer(reconstruction.stages, "simplify");
  std::vector<ObjectResult>& objects = reconstruction.objects;
  context.begin_phase("simplify", objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    TURNSCAN_TRY(context.check());
    ObjectResult& object = objects[i];
    const Bound bound = bound_for(options, wanted, object, reconstruction.voxel_size_m);
    const std::size_t all = object.mesh.triangles.size();
    TURNSCAN_TRY(reduce_object(bound, object, context));
    const int number = objects.size() > 1 ? int(i) : -1;
    reconstruction.choices.push_back({"triangles", std::to_string(object.mesh.triangles.size()),
                                      fmt::format("of {}: {}", all, bound.reason), number});
    context.advance();
  }
  return {};
}

}  // namespace turnscan::finishing
