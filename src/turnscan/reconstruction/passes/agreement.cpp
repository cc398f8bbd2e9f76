#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/passes/agreement.hpp>

namespace turnscan::passes {

namespace {

/// A square metre seen to be empty outweighs so many that agree: surfaces meet by chance, rays do
/// not pass through matter.
constexpr double kAgainst = 3.0;
constexpr float kAgreeCos = 0.8f;

void add_direction(const SurfaceLevel& source, const SurfaceLevel& target, const FreeSpace& free,
                   const Eigen::Isometry3f& T, float tolerance, std::size_t stride,
                   Agreement& out) {
  // The nearest sample lies beside the point, but not farther than samples do.
  const auto beside = float(1.5 * target.samples.spacing_m + tolerance);
  for (std::size_t i = 0; i < source.samples.size(); ++i) {
    const Vec3f q = T * source.samples.points[i];
    const double area = 0.5 * double(source.samples.areas[i]);
    const std::uint32_t near = target.nearest(q);
    if (near != NearestGrid::kNone) {
      const Vec3f n = T.linear() * source.samples.normals[i];
      const Vec3f& np = target.samples.normals[near];
      const Vec3f apart = target.samples.points[near] - q;
      const float r = (n + np).normalized().dot(apart) / tolerance;
      if (n.dot(np) > kAgreeCos && std::abs(r) < 1.0f && apart.norm() < beside) {
        out.agreeing_m2 += area;
        out.score_m2 += area * double(1.0f - r * r);
        out.rms_m += area * double(r * r);
        continue;
      }
    }
    if (free.empty_at(q, stride)) out.against_m2 += area;
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
  add_direction(of_b, of_a, a.free, T, float(tolerance_m), stride, out);
  add_direction(of_a, of_b, b.free, T.inverse(), float(tolerance_m), stride, out);
  if (out.agreeing_m2 > 0.0) out.rms_m = tolerance_m * std::sqrt(out.rms_m / out.agreeing_m2);
  out.score_m2 -= kAgainst * out.against_m2;
  return out;
}

double motion_distance(const PreparedPass& b, const Pose& one, const Pose& other) {
  const Eigen::Isometry3f between = (one.inverse() * other).cast<float>();
  double sum = 0.0;
  for (const Vec3f& p : b.coarse.samples.points) sum += double((between * p - p).squaredNorm());
  return std::sqrt(sum / double(std::max<std::size_t>(1, b.coarse.samples.size())));
}

}  // namespace turnscan::passes
