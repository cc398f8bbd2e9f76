#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_creases.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>
#include <utility>

namespace turnscan::mesh_refinement {

namespace {

/// Rings of vertices around that both models are fitted to: of the two sizes the one in which the
/// planes are the clearer.
constexpr std::array<int, 2> kCreaseRings{4, 6};
/// Least angle between the planes, and between normals in the rings where a crease is looked for:
/// cosines of 30 and of 15 degrees.
constexpr float kMaxCosine = 0.866f, kBendCosine = 0.966f;
/// In mean edges: vertices closer to the crease do not determine the planes; those within the next
/// move; maximum motion.
constexpr float kRounded = 1.0f, kBeside = 1.5f, kMaxMotion = 0.7f;
/// Planes that are farther off than this, in mean edges, are no model of the surface: three and
/// more faces meet, as where teeth end.
constexpr float kMaxMisfit = 0.4f;
/// Fewer vertices on either side do not determine a plane.
constexpr float kMinSide = 6.0f;
/// Residuals are cut off at this many standard deviations (Tukey).
constexpr float kPlaneCut = 4.0f;
constexpr int kPlaneRounds = 3;  // of the robust fits

/// A vertex relative to the one that is looked at.
struct Sample {
  Vec3f position, normal;
  float weight;
  bool rounded = false;  ///< too close to the crease to have a normal of either side
};
using Samples = std::span<const Sample>;

/// Weighted sums over samples; positions are close to 0, so that they lose no digits.
struct Sums {
  float weight = 0.0f;
  Vec3f position = Vec3f::Zero(), normal = Vec3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();  ///< of positions

  void add(const Sample& sample, float w) {
    const Vec3f weighted = w * sample.position;
    weight += w;
    position += weighted;
    normal += w * sample.normal;
    squares += weighted * sample.position.transpose();
  }
};

struct Plane {
  Vec3f normal = Vec3f::Zero();
  float offset = 0.0f;
  float above(const Vec3f& p) const { return normal.dot(p) - offset; }
};

float tukey(float residual, float cut) {
  return float(estimation::tukey_weight(double(residual / cut)));
}

/// Eigenvectors of a symmetric matrix, by increasing eigenvalue.
Eigen::Matrix3f axes_of(const Eigen::Matrix3f& symmetric) {
  return estimation::symmetric_eigen<3>(symmetric.cast<double>()).vectors.cast<float>();
}

/// The plane with the least squares of distances; its normal points as those of the samples.
std::optional<Plane> plane_through(const Sums& sums) {
  if (sums.weight < kMinSide) return std::nullopt;
  const Vec3f middle = sums.position / sums.weight;
  const Eigen::Matrix3f spread = sums.squares - middle * sums.position.transpose();
  Plane out;
  out.normal = axes_of(spread / spread.trace()).col(0);
  if (out.normal.dot(sums.normal) < 0.0f) out.normal = -out.normal;
  out.offset = out.normal.dot(middle);
  return out;
}

/// Two planes, which bound what is inside of both (an edge) or of either (a groove).
struct Crease {
  std::array<Plane, 2> plane;
  bool edge = true;
  Vec3f along = Vec3f::Zero(), through = Vec3f::Zero();  ///< the line in which they meet
  float misfit = 1.0f;                                   ///< over that of a quadratic surface

  /// From a point to the nearest one of the line.
  Vec3f to_line(const Vec3f& p) const {
    const Vec3f d = through - p;
    return d - d.dot(along) * along;
  }
  /// The plane that bounds the inside at a point.
  const Plane& at(const Vec3f& p) const {
    return plane[(plane[0].above(p) > plane[1].above(p)) == edge ? 0 : 1];
  }
};

bool meet(Crease& crease) {
  const auto& [a, b] = crease.plane;
  const float cosine = a.normal.dot(b.normal);
  if (std::abs(cosine) > kMaxCosine) return false;
  crease.along = a.normal.cross(b.normal).normalized();
  crease.through =
      ((a.offset - b.offset * cosine) * a.normal + (b.offset - a.offset * cosine) * b.normal) /
      (1.0f - cosine * cosine);
  return true;
}

/// Root mean square of what separates samples from a model, cut off: their distance and, in mean
/// edges, the difference of the normals, which noise of the distance turns by as much. The crease's
/// own vertices have normals between both.
template <class Model>
float misfit(Samples samples, float cut, float edge_m, const Model& model) {
  float squares = 0.0f, sum = 0.0f;
  for (const Sample& s : samples) {
    const auto [distance, normal] = model(s.position);
    const float turned = s.rounded ? 0.0f : edge_m * (s.normal - normal).norm();
    squares += s.weight * std::min(distance * distance + turned * turned, cut * cut);
    sum += s.weight;
  }
  return std::sqrt(squares / sum);
}

/// That of a robustly fitted quadratic height field over a plane.
float quadratic_misfit(Samples samples, const Vec3f& up, float cut, float edge_m) {
  using Row = Eigen::Matrix<float, 6, 1>;
  const Vec3f across = up.unitOrthogonal(), other = up.cross(across);
  float reach = 0.0f;
  for (const Sample& s : samples) reach = std::max(reach, s.position.norm());
  const auto row_of = [&](const Vec3f& p) {
    const float x = p.dot(across) / reach, y = p.dot(other) / reach;
    return Row{1.0f, x, y, x * x, x * y, y * y};
  };
  Row k = Row::Zero();
  const auto field = [&](const Vec3f& p) {
    const Row row = row_of(p);
    const Vec3f slope = (k[1] + 2.0f * k[3] * row[1] + k[4] * row[2]) / reach * across +
                        (k[2] + 2.0f * k[5] * row[2] + k[4] * row[1]) / reach * other;
    const Vec3f normal = (up - slope).normalized();
    return std::pair((p.dot(up) - row.dot(k)) * normal.dot(up), normal);
  };
  float best = std::numeric_limits<float>::max();
  for (int round = 0; round < kPlaneRounds; ++round) {
    Eigen::Matrix<float, 6, 6> left = Eigen::Matrix<float, 6, 6>::Zero();
    Row right = Row::Zero();
    for (const Sample& s : samples) {
      const float weight = s.weight * (round == 0 ? 1.0f : tukey(field(s.position).first, cut));
      const Row row = row_of(s.position);
      left += weight * row * row.transpose();
      right += weight * s.position.dot(up) * row;
    }
    k = estimation::solve_ldlt(estimation::Matrix6d(left.cast<double>()),
                               estimation::Vector6d(right.cast<double>()))
            .cast<float>();
    best = std::min(best, misfit(samples, cut, edge_m, field));
  }
  return best;
}

/// Samples by the plane that is closer, unless the crease is too close.
struct Division {
  std::array<Sums, 2> sides;
  float cut = 0.0f;  ///< distance at which residuals are cut off
};

Division divide(std::span<Sample> samples, const Crease& crease, float rounded) {
  const auto& [a, b] = crease.plane;
  std::vector<float> distances(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    distances[i] =
        std::min(std::abs(a.above(samples[i].position)), std::abs(b.above(samples[i].position)));
  std::vector<float> ordered = distances;
  Division out;
  out.cut = kPlaneCut * float(estimation::mad_sigma(ordered));
  if (!(out.cut > 0.0f)) return out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Sample& sample = samples[i];
    sample.rounded = !(crease.to_line(sample.position).norm() > rounded);
    const std::size_t side = distances[i] == std::abs(a.above(sample.position)) ? 0 : 1;
    if (!sample.rounded && distances[i] < out.cut)
      out.sides[side].add(sample, sample.weight * tukey(distances[i], out.cut));
  }
  return out;
}

/// Samples on both sides of the mean of the normals, along the axis in which those differ most.
std::optional<Division> divide_by_normals(Samples samples) {
  Sums all;
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  for (const Sample& s : samples) {
    all.add(s, s.weight);
    squares += s.weight * s.normal * s.normal.transpose();
  }
  if (all.weight < 2.0f * kMinSide) return std::nullopt;
  const Vec3f mean = all.normal / all.weight;
  const Vec3f apart = axes_of(squares - mean * all.normal.transpose()).col(2);
  Division out;
  for (const Sample& s : samples)
    out.sides[apart.dot(s.normal - mean) > 0.0f ? 0 : 1].add(s, s.weight);
  const Vec3f &a = out.sides[0].normal, &b = out.sides[1].normal;
  // Rounded in the middle, so that the means differ less than the planes.
  if (a.dot(b) > kBendCosine * a.norm() * b.norm()) return std::nullopt;
  return out;
}

std::optional<Crease> crease_in(std::span<Sample> samples, float edge_m) {
  std::optional<Division> division = divide_by_normals(samples);
  if (!division) return std::nullopt;
  const Vec3f up = (division->sides[0].normal + division->sides[1].normal).normalized();
  Crease out;
  for (int round = 0; round < kPlaneRounds; ++round) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::optional<Plane> plane = plane_through(division->sides[side]);
      if (!plane) return std::nullopt;
      out.plane[side] = *plane;
    }
    if (!meet(out)) return std::nullopt;
    if (round > 0 && out.to_line(Vec3f::Zero()).norm() > 2.0f * kBeside * edge_m)
      return std::nullopt;  // too far to move the vertex, whatever the next rounds find
    division = divide(samples, out, kRounded * edge_m);
  }
  const auto& [a, b] = division->sides;
  out.edge = a.position.dot(out.plane[1].normal) - a.weight * out.plane[1].offset +
                 b.position.dot(out.plane[0].normal) - b.weight * out.plane[0].offset <
             0.0f;
  const float planes = misfit(samples, division->cut, edge_m, [&](const Vec3f& p) {
    return std::pair(out.at(p).above(p), out.at(p).normal);
  });
  if (!(planes < kMaxMisfit * edge_m)) return std::nullopt;
  const float quadratic = quadratic_misfit(samples, up, division->cut, edge_m);
  if (!(planes < quadratic)) return std::nullopt;
  out.misfit = planes / quadratic;
  return out;
}

class CreaseSearch {
 public:
  CreaseSearch(const TriangleMesh& mesh, const std::vector<float>& support)
      : mesh_(mesh),
        neighbours_(mesh),
        normals_(vertex_normals(mesh)),
        measured_(measured_shares(support)) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles)
      sum += double((mesh.vertices[t[0]] - mesh.vertices[t[1]]).norm());
    edge_m_ = float(sum / double(std::max<std::size_t>(1, mesh.triangles.size())));
  }

  Result<std::vector<Vec3f>> steps(const RunContext& context) const {
    std::vector<float> bends(mesh_.vertices.size());
    parallel_for(bends.size(), 4096, [&](std::size_t v) {
      float cosine = 1.0f;
      neighbours_.each(
          v, [&](std::uint32_t u) { cosine = std::min(cosine, normals_[v].dot(normals_[u])); });
      bends[v] = cosine;
    });
    std::vector<std::uint32_t> bent;
    for (std::uint32_t v = 0; v < bends.size(); ++v)
      if (bends[v] <= kBendCosine && measured_[v] >= 1.0f) bent.push_back(v);
    std::vector<Vec3f> out(bends.size(), Vec3f::Zero());
    // A few parts: each has marks for all vertices.
    constexpr std::size_t kParts = 32;
    TURNSCAN_TRY(parallel_for(kParts, 1, context, [&](std::size_t part) {
      std::vector<std::uint32_t> found_by(bends.size(), kNobody);
      for (std::size_t i = part; i < bent.size(); i += kParts)
        if (const auto crease = crease_around(bent[i], found_by))
          out[bent[i]] = step_onto(*crease, bent[i]);
    }));
    return out;
  }

 private:
  static constexpr std::uint32_t kNobody = 0xffffffffu;

  std::optional<Crease> crease_around(std::uint32_t v, std::vector<std::uint32_t>& found_by) const {
    std::vector<std::uint32_t> found{v};
    found_by[v] = v;
    std::size_t from = 0;
    std::vector<Sample> samples;
    std::optional<Crease> best;
    int ring = 0;
    for (const int rings : kCreaseRings) {
      for (; ring < rings; ++ring) {
        const std::size_t to = found.size();
        for (std::size_t i = from; i < to; ++i)
          neighbours_.each(found[i], [&](std::uint32_t u) {
            if (std::exchange(found_by[u], v) != v) found.push_back(u);
          });
        from = to;
      }
      samples.clear();
      for (const std::uint32_t u : found)
        samples.push_back({mesh_.vertices[u] - mesh_.vertices[v], normals_[u], measured_[u]});
      const auto crease = crease_in(samples, edge_m_);
      if (crease && (!best || crease->misfit < best->misfit)) best = crease;
    }
    return best;
  }

  Vec3f step_onto(const Crease& crease, std::uint32_t v) const {
    const Vec3f own = Vec3f::Zero(), to_line = crease.to_line(own);
    if (to_line.norm() > kBeside * edge_m_) return own;
    const Plane& plane = crease.at(own);
    // Where an edge of the mesh crosses the crease its closer end belongs on it.
    bool crosses = false;
    neighbours_.each(v, [&](std::uint32_t u) {
      const Vec3f p = mesh_.vertices[u] - mesh_.vertices[v];
      crosses |= &crease.at(p) != &plane && crease.to_line(p).norm() > to_line.norm();
    });
    const Vec3f step = crosses ? to_line : Vec3f(-plane.above(own) * plane.normal);
    return step * std::min(1.0f, kMaxMotion * edge_m_ / std::max(step.norm(), 1e-12f));
  }

  const TriangleMesh& mesh_;
  MeshNeighbours neighbours_;
  std::vector<Vec3f> normals_;
  std::vector<float> measured_;
  float edge_m_ = 0.0f;
};

}  // namespace

Result<> straighten_creases(TriangleMesh& mesh, const std::vector<float>& support,
                            const RunContext& context) {
  TURNSCAN_ASSIGN(std::vector<Vec3f> steps, CreaseSearch(mesh, support).steps(context));
  take_steps(mesh, std::move(steps));
  return {};
}

}  // namespace turnscan::mesh_refinement
