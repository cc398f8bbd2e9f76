#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <turnscan/reconstruction/passes/agreement.hpp>

namespace turnscan::passes {

namespace {

/// Area of agreement that is outweighed by a unit of area in free space: surfaces meet by chance,
/// but rays do not pass through matter.
constexpr double kAgainst = 3.0;
constexpr float kAgreeCos = 0.8f;

/// Evidence of one sample of a surface about a motion.
enum class Says { kNothing, kAgrees, kOpposes };
struct Statement {
  Says says = Says::kNothing;
  float r2 = 0.0f;  ///< squared distance relative to the tolerance
  double score() const {
    return says == Says::kAgrees ? double(1.0f - r2) : says == Says::kOpposes ? -kAgainst : 0.0;
  }
};

/// The samples of one surface compared with the other surface and the free space of its pass.
struct Direction {
  const SurfaceLevel& source;
  const SurfaceLevel& target;
  const FreeSpace& free;
  Eigen::Isometry3f T_target_source;
  float tolerance;
  std::size_t stride;  ///< of the views

  /// The sample with which a sample agrees; kNone: none.
  struct Partner {
    std::uint32_t sample = NearestGrid::kNone;
    float r2 = 0.0f;
  };
  Partner partner(std::size_t i) const {
    const Vec3f q = T_target_source * source.samples.points[i];
    const std::uint32_t near = target.nearest(q);
    if (near == NearestGrid::kNone) return {};
    const Vec3f n = T_target_source.linear() * source.samples.normals[i];
    const Vec3f& np = target.samples.normals[near];
    const Vec3f apart = target.samples.points[near] - q;
    const float r = (n + np).normalized().dot(apart) / tolerance;
    // The nearest sample is beside the point, but no farther than the sample spacing.
    const auto beside = float(1.5 * target.samples.spacing_m) + tolerance;
    if (n.dot(np) > kAgreeCos && std::abs(r) < 1.0f && apart.norm() < beside) return {near, r * r};
    return {};
  }

  Statement statement(std::size_t i) const {
    const Partner with = partner(i);
    if (with.sample != NearestGrid::kNone) return {Says::kAgrees, with.r2};
    const Vec3f q = T_target_source * source.samples.points[i];
    return {free.empty_at(q, stride) ? Says::kOpposes : Says::kNothing, 0.0f};
  }
  double area(std::size_t i) const { return 0.5 * double(source.samples.areas[i]); }
};

void add(const Direction& direction, Agreement& out) {
  for (std::size_t i = 0; i < direction.source.samples.size(); ++i) {
    const Statement s = direction.statement(i);
    const double area = direction.area(i);
    out.score_m2 += area * s.score();
    if (s.says == Says::kOpposes) out.against_m2 += area;
    if (s.says != Says::kAgrees) continue;
    out.agreeing_m2 += area;
    out.rms_m += area * double(s.r2);
  }
}

/// Errors of a fitted mesh are correlated over a few of its cells.
constexpr float kEvidenceBlock_m = 0.008f;

/// Adds the difference of the two motions' scores for each block of the surface.
void add_differences(const Direction& one, const Direction& other, double& sum, double& squares) {
  std::map<std::array<int, 3>, double> blocks;
  for (std::size_t i = 0; i < one.source.samples.size(); ++i) {
    const double difference = one.area(i) * (one.statement(i).score() - other.statement(i).score());
    const Eigen::Vector3i at =
        (one.source.samples.points[i] / kEvidenceBlock_m).array().floor().cast<int>();
    blocks[{at.x(), at.y(), at.z()}] += difference;
  }
  for (const auto& [at, difference] : blocks) {
    sum += difference;
    squares += difference * difference;
  }
}

}  // namespace

Agreement compare(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                  double tolerance_m, Density density) {
  const bool coarse = density == Density::kCoarse;
  const SurfaceLevel& of_a = coarse ? a.coarse : a.medium;
  const SurfaceLevel& of_b = coarse ? b.coarse : b.medium;
  const Eigen::Isometry3f T = T_a_b.cast<float>();
  const std::size_t stride = coarse ? 3 : 1;
  Agreement out;
  add({of_b, of_a, a.free, T, float(tolerance_m), stride}, out);
  add({of_a, of_b, b.free, T.inverse(), float(tolerance_m), stride}, out);
  if (out.agreeing_m2 > 0.0) out.rms_m = tolerance_m * std::sqrt(out.rms_m / out.agreeing_m2);
  return out;
}

std::vector<std::uint32_t> agreeing_partners(const PreparedPass& a, const PreparedPass& b,
                                             const Pose& T_a_b, double tolerance_m,
                                             Density density) {
  const bool coarse = density == Density::kCoarse;
  const Direction direction{coarse ? b.coarse : b.medium, coarse ? a.coarse : a.medium, a.free,
                            T_a_b.cast<float>(),          float(tolerance_m),           1};
  std::vector<std::uint32_t> out(direction.source.samples.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = direction.partner(i).sample;
  return out;
}

double preference(const PreparedPass& a, const PreparedPass& b, const Pose& one, const Pose& other,
                  double tolerance_m) {
  const Eigen::Isometry3f T = one.cast<float>(), T_other = other.cast<float>();
  const auto tolerance = float(tolerance_m);
  double sum = 0.0, squares = 0.0;
  add_differences({b.medium, a.medium, a.free, T, tolerance, 1},
                  {b.medium, a.medium, a.free, T_other, tolerance, 1}, sum, squares);
  add_differences({a.medium, b.medium, b.free, T.inverse(), tolerance, 1},
                  {a.medium, b.medium, b.free, T_other.inverse(), tolerance, 1}, sum, squares);
  return squares > 0.0 ? sum / std::sqrt(squares) : 0.0;
}

double motion_distance(const PreparedPass& b, const Pose& one, const Pose& other) {
  const Pose between = one.inverse() * other;
  const Eigen::Matrix3d turn = between.linear() - Eigen::Matrix3d::Identity();
  const Vec3d shift = turn * b.middle + between.translation();
  return std::sqrt(std::max(0.0, (turn * b.scatter * turn.transpose()).trace()) +
                   shift.squaredNorm());
}

}  // namespace turnscan::passes
