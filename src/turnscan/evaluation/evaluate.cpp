#include <turnscan/evaluation/evaluate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>
#include <turnscan/geometry/search/sample.hpp>

namespace turnscan {
namespace {

constexpr int kAlignSamples = 20000;
constexpr std::size_t kChunk = 1024;  // samples between checks of the context
constexpr std::size_t kMaxThresholds = 64;

Vec3f triangle_normal(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d o = mesh.vertices[a].cast<double>();
  const Vec3d normal =
      (mesh.vertices[b].cast<double>() - o).cross(mesh.vertices[c].cast<double>() - o);
  return normal.normalized().cast<float>();
}

/// Tests whether points are on open edges of a mesh.
class OpenEdges {
 public:
  explicit OpenEdges(const TriangleMesh& mesh)
      : mesh_(mesh), open_(mesh.triangles.size(), 0), corner_(mesh.vertices.size(), 0) {
    // Every edge from its lower to its higher vertex, with the triangle and the corner at which it
    // starts.
    std::vector<std::array<std::uint32_t, 4>> edges;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3]);
        edges.push_back({low, high, t, c});
      }
    }
    std::sort(edges.begin(), edges.end());
    const auto same = [&](std::size_t a, std::size_t b) {
      return b < edges.size() && edges[a][0] == edges[b][0] && edges[a][1] == edges[b][1];
    };
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (same(e, e + 1) || (e > 0 && same(e, e - 1))) continue;
      open_[edges[e][2]] |= std::uint8_t(1u << edges[e][3]);
      corner_[edges[e][0]] = corner_[edges[e][1]] = 1;
    }
  }

  bool contain(const Vec3d& point, std::uint32_t triangle) const {
    constexpr double kSame = 1e-9;  // metres
    const auto& t = mesh_.triangles[triangle];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d a = mesh_.vertices[t[c]].cast<double>();
      const Vec3d b = mesh_.vertices[t[(c + 1) % 3]].cast<double>();
      if (corner_[t[c]] != 0 && (point - a).norm() < kSame) return true;
      if ((open_[triangle] >> c & 1) == 0) continue;
      if ((closest_point_on_triangle(point, a, b, b) - point).norm() < kSame) return true;
    }
    return false;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::uint8_t> open_;    // one bit per edge of each triangle
  std::vector<std::uint8_t> corner_;  // per vertex
};

/// Nearest point of each sample on the other surface.
struct Nearest {
  std::vector<double> distance;
  std::vector<Vec3d> points;   // on the other surface
  std::vector<Vec3f> normals;  // of the triangle there
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint8_t> on_border;  // 1: on an open edge of it
};

Result<Nearest> nearest_on(const TriangleMesh& surface, const std::vector<Vec3f>& samples,
                           const char* phase, Border border, const RunContext& context) {
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(surface, context));
  const std::size_t n = samples.size();
  Nearest nearest;
  nearest.distance.resize(n);
  nearest.points.resize(n);
  nearest.normals.resize(n);
  nearest.triangles.resize(n);
  nearest.on_border.assign(n, 0);
  const std::optional<OpenEdges> open =
      border == Border::kLeaveOut ? std::optional<OpenEdges>(surface) : std::nullopt;
  context.begin_phase(phase, n);
  TURNSCAN_TRY(parallel_for((n + kChunk - 1) / kChunk, 1, context, [&](std::size_t chunk) {
    const std::size_t end = std::min(n, (chunk + 1) * kChunk);
    // Where thousands of slivers meet, one sample may take milliseconds.
    for (std::size_t i = chunk * kChunk; i < end && !context.cancelled(); ++i) {
      const auto hit = distance.closest(samples[i].cast<double>());
      nearest.distance[i] = hit.distance;
      nearest.points[i] = hit.point;
      nearest.triangles[i] = hit.triangle;
      nearest.normals[i] = triangle_normal(surface, hit.triangle);
      if (open && open->contain(hit.point, hit.triangle)) nearest.on_border[i] = 1;
    }
    context.advance(end - chunk * kChunk);
  }));
  return nearest;
}

std::vector<Vec3f> as_floats(const std::vector<Vec3d>& points) {
  std::vector<Vec3f> floats(points.size());
  std::transform(points.begin(), points.end(), floats.begin(),
                 [](const Vec3d& p) { return p.cast<float>(); });
  return floats;
}

Result<std::vector<std::uint8_t>> which_seen(const SeenTest& seen, const std::vector<Vec3f>& points,
                                             const std::vector<Vec3f>& normals) {
  if (!seen) return std::vector<std::uint8_t>(points.size(), 1);
  TURNSCAN_ASSIGN(std::vector<std::uint8_t> result, seen(points, normals));
  if (result.size() != points.size()) {
    return fail(ErrorCode::kLibrary, "evaluate: {} answers for {} points; correct the seen test",
                result.size(), points.size());
  }
  return result;
}

std::vector<double> select(const std::vector<double>& values, const std::vector<std::uint8_t>& mask,
                           bool wanted) {
  std::vector<double> selected;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if ((mask[i] != 0) == wanted) selected.push_back(values[i]);
  }
  return selected;
}

double fraction_within(const std::vector<double>& distances, double threshold) {
  if (distances.empty()) return 0.0;
  const auto within =
      std::count_if(distances.begin(), distances.end(), [&](double d) { return d <= threshold; });
  return double(within) / double(distances.size());
}

double fraction_seen(const std::vector<std::uint8_t>& seen) {
  const auto count = std::count_if(seen.begin(), seen.end(), [](std::uint8_t s) { return s != 0; });
  return seen.empty() ? 0.0 : double(count) / double(seen.size());
}

/// Mean offset of the samples that count from the surface, along its normals.
double bias(const std::vector<Vec3f>& samples, const Nearest& nearest,
            const std::vector<std::uint8_t>& counts) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (counts[i] == 0) continue;
    const Vec3d way = samples[i].cast<double>() - nearest.points[i];
    sum += way.dot(nearest.normals[i].cast<double>());
    ++count;
  }
  return count > 0 ? sum / double(count) : 0.0;
}

/// Distances of the samples that count, negative inside the reference.
Result<std::vector<double>> signed_distances(const std::vector<Vec3f>& samples,
                                             const Nearest& nearest,
                                             const std::vector<std::uint8_t>& counts,
                                             const TriangleMesh& reference,
                                             const RunContext& context) {
  TURNSCAN_ASSIGN(const PseudoNormals normals, PseudoNormals::create(reference, context));
  std::vector<double> all(samples.size());
  TURNSCAN_TRY(parallel_for(samples.size(), kChunk, context, [&](std::size_t i) {
    const Vec3d way = samples[i].cast<double>() - nearest.points[i];
    const double side = way.dot(normals.at(nearest.points[i], nearest.triangles[i]));
    all[i] = std::copysign(nearest.distance[i], side);
  }));
  return select(all, counts, true);
}

ToleranceShares tolerance_shares(const std::vector<double>& deviations, double tolerance_m) {
  ToleranceShares shares{tolerance_m, 0.0, 0.0, 0.0};
  if (deviations.empty()) return shares;
  const double each = 1.0 / double(deviations.size());
  std::size_t above = 0, below = 0;
  for (const double d : deviations) {
    above += d > tolerance_m ? 1 : 0;
    below += d < -tolerance_m ? 1 : 0;
  }
  shares.above = each * double(above);
  shares.below = each * double(below);
  shares.in = each * double(deviations.size() - above - below);
  return shares;
}

Result<TriangleMesh> align(const TriangleMesh& mesh, const TriangleMesh& reference,
                           const EvaluateOptions& options, const RunContext& context,
                           Evaluation& out) {
  context.begin_phase("align", 0);
  TURNSCAN_ASSIGN(const SurfaceSamples samples,
                  sample_surface(mesh, kAlignSamples, std::uint64_t(options.seed), context));
  TURNSCAN_ASSIGN(const IcpResult result,
                  icp(samples.points, reference, Pose::Identity(), options.icp, context));
  out.aligned = true;
  out.T_reference_mesh = result.T_target_source;
  out.alignment_rms_m = result.rms_m;
  return transformed(mesh, result.T_target_source);
}

Result<> compare(const TriangleMesh& mesh, const TriangleMesh& reference,
                 const EvaluateOptions& options, const SeenTest& seen, const RunContext& context,
                 Evaluation& out) {
  const auto count = std::size_t(options.samples);
  const auto seed = std::uint64_t(options.seed);
  context.begin_phase("sample", 0);
  TURNSCAN_ASSIGN(const SurfaceSamples on_mesh, sample_surface(mesh, count, seed, context));
  TURNSCAN_ASSIGN(const SurfaceSamples on_reference,
                  sample_surface(reference, count, seed + 1, context));
  TURNSCAN_ASSIGN(const Nearest to_reference,
                  nearest_on(reference, on_mesh.points, "accuracy", options.border, context));
  TURNSCAN_ASSIGN(const Nearest to_mesh,
                  nearest_on(mesh, on_reference.points, "completeness", Border::kCount, context));
  if (seen) context.begin_phase("seen", 0);
  TURNSCAN_ASSIGN(const auto reference_seen,
                  which_seen(seen, on_reference.points, on_reference.normals));
  TURNSCAN_TRY(context.check());
  const std::vector<Vec3f> nearest_points = as_floats(to_reference.points);
  TURNSCAN_ASSIGN(auto mesh_seen, which_seen(seen, nearest_points, to_reference.normals));
  TURNSCAN_TRY(context.check());
  for (std::size_t i = 0; i < mesh_seen.size(); ++i) {
    if (to_reference.on_border[i] != 0) mesh_seen[i] = 0;
  }

  const std::vector<double> accurate = select(to_reference.distance, mesh_seen, true);
  const std::vector<double> complete = select(to_mesh.distance, reference_seen, true);
  if (complete.empty()) {
    return fail(ErrorCode::kTooFewPoints,
                "evaluate: nothing of the reference was seen; check that it lies in the frame of "
                "the recording");
  }
  out.accuracy = error_statistics(accurate);
  out.completeness = error_statistics(complete);
  out.invented = error_statistics(select(to_reference.distance, mesh_seen, false));
  TURNSCAN_ASSIGN(const auto deviations,
                  signed_distances(on_mesh.points, to_reference, mesh_seen, reference, context));
  out.deviation = deviation_statistics(deviations);
  if (options.tolerance_m) out.tolerance = tolerance_shares(deviations, *options.tolerance_m);
  out.bias_m = bias(on_mesh.points, to_reference, mesh_seen);
  out.mesh_area_m2 = on_mesh.area_m2;
  out.reference_area_m2 = on_reference.area_m2;
  out.seen_area_m2 = on_reference.area_m2 * fraction_seen(reference_seen);
  out.invented_area_m2 = on_mesh.area_m2 * (1.0 - fraction_seen(mesh_seen));
  for (ThresholdScore& score : out.scores) {
    score.precision = fraction_within(accurate, score.threshold_m);
    score.recall = fraction_within(complete, score.threshold_m);
    const double sum = score.precision + score.recall;
    score.f = sum > 0.0 ? 2.0 * score.precision * score.recall / sum : 0.0;
  }
  return {};
}

}  // namespace

OptionTable describe(EvaluateOptions& options) {
  OptionTable table;
  table.text("thresholds", options.thresholds,
             "Distances at which precision, recall and F are given, separated by commas.");
  table.number("samples", options.samples, {1, 100000000},
               "Points drawn from each of the two surfaces.");
  table.number("sample-seed", options.seed, {0, 2147483647}, "Seed of the points drawn.");
  table.choice(
      "border", options.border, {"count", "leave-out"},
      "Parts of the mesh that are nearest to an open edge of the reference, such as those that "
      "close its holes. leave-out: they are evaluated separately, like unseen surface.");
  table.number("tolerance", options.tolerance_m, Quantity::kLength, {1e-6, 1.0},
               "Also give the shares of the mesh within this distance of the reference, above it "
               "(outside) and below it (inside); auto: no tolerance.");
  table.choice("align", options.align, {"none", "icp"},
               "icp: move the mesh rigidly onto the reference before they are compared.");
  table.append(describe(options.icp));
  return table;
}

Result<std::vector<double>> parse_thresholds(std::string_view text) {
  std::vector<double> thresholds;
  while (true) {
    const std::size_t comma = text.find(',');
    TURNSCAN_ASSIGN(const double value, parse_quantity(text.substr(0, comma), Quantity::kLength));
    if (!(value > 0.0) || thresholds.size() == kMaxThresholds) {
      return fail(ErrorCode::kInvalidOption,
                  "thresholds: '{}' is not allowed; give up to {} positive lengths, as 0.5mm,1mm",
                  text, kMaxThresholds);
    }
    thresholds.push_back(value);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  std::sort(thresholds.begin(), thresholds.end());
  return thresholds;
}

ErrorStatistics error_statistics(std::vector<double> distances) {
  ErrorStatistics statistics;
  statistics.count = distances.size();
  if (distances.empty()) return statistics;
  std::sort(distances.begin(), distances.end());
  double sum = 0.0, squares = 0.0;
  for (const double d : distances) {
    sum += d;
    squares += d * d;
  }
  const auto n = double(distances.size());
  const auto rank = [&](double part) { return distances[std::size_t(std::ceil(part * n)) - 1]; };
  statistics.mean = sum / n;
  statistics.rms = std::sqrt(squares / n);
  statistics.median = rank(0.5);
  statistics.p95 = rank(0.95);
  statistics.max = distances.back();
  return statistics;
}

DeviationStatistics deviation_statistics(std::vector<double> deviations) {
  DeviationStatistics statistics;
  statistics.count = deviations.size();
  if (deviations.empty()) return statistics;
  std::sort(deviations.begin(), deviations.end());
  const auto n = double(deviations.size());
  double sum = 0.0, squares = 0.0;
  for (const double d : deviations) sum += d;
  statistics.mean = sum / n;
  for (const double d : deviations) squares += (d - statistics.mean) * (d - statistics.mean);
  const auto rank = [&](double part) { return deviations[std::size_t(std::ceil(part * n)) - 1]; };
  statistics.sigma = std::sqrt(squares / n);
  statistics.low = rank(0.025);
  statistics.high = rank(0.975);
  statistics.min = deviations.front();
  statistics.max = deviations.back();
  return statistics;
}

TriangleMesh transformed(const TriangleMesh& mesh, const Pose& pose) {
  TriangleMesh moved = mesh;
  for (Vec3f& v : moved.vertices) v = (pose * v.cast<double>()).cast<float>();
  for (Vec3f& n : moved.normals) n = (pose.linear() * n.cast<double>()).cast<float>();
  return moved;
}

Result<Evaluation> evaluate(const TriangleMesh& mesh, const TriangleMesh& reference,
                            const EvaluateOptions& options, const SeenTest& seen,
                            const RunContext& context) {
  EvaluateOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  TURNSCAN_ASSIGN(const std::vector<double> thresholds, parse_thresholds(options.thresholds));
  TURNSCAN_TRY(validate_mesh(mesh, "mesh"));
  TURNSCAN_TRY(validate_mesh(reference, "reference"));
  Evaluation out;
  for (const double threshold : thresholds) out.scores.push_back({threshold, 0.0, 0.0, 0.0});
  if (options.align == Align::kIcp) {
    TURNSCAN_ASSIGN(const TriangleMesh moved, align(mesh, reference, options, context, out));
    TURNSCAN_TRY(compare(moved, reference, options, seen, context, out));
  } else {
    TURNSCAN_TRY(compare(mesh, reference, options, seen, context, out));
  }
  return out;
}

}  // namespace turnscan
