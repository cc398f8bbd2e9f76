#include <turnscan/reconstruction/passes/coarse_alignment.hpp>

#include <Eigen/Cholesky>

namespace turnscan::passes {

namespace {

constexpr float kAlignCos = 0.6f;

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Vec6f = Eigen::Matrix<float, 6, 1>;

/// Sums of weighted squares, in the frame of a, about a center.
struct Sums {
  Eigen::Matrix<float, 6, 6> matrix = Eigen::Matrix<float, 6, 6>::Zero();
  Vec6f vector = Vec6f::Zero();

  /// Pairs of the source's points with the target's nearest. back: from the target's frame to a's.
  void add(const SurfaceLevel& source, const SurfaceLevel& target,
           const Eigen::Isometry3f& T_target_source, const Eigen::Isometry3f& T_a_target,
           bool source_moves, const Vec3f& center, float reach) {
    for (std::size_t i = 0; i < source.samples.size(); ++i) {
      const Vec3f q = T_target_source * source.samples.points[i];
      const std::uint32_t near = target.nearest(q);
      if (near == NearestGrid::kNone) continue;
      const Vec3f nq = T_target_source.linear() * source.samples.normals[i];
      const Vec3f& np = target.samples.normals[near];
      const Vec3f apart = target.samples.points[near] - q;
      if (nq.dot(np) < kAlignCos || apart.squaredNorm() > reach * reach) continue;
      const Vec3f n_target = (np + nq).normalized();
      const float r = n_target.dot(apart) * (source_moves ? 1.0f : -1.0f);
      const float u = 1.0f - r * r / (reach * reach), w = u * u * source.samples.areas[i];
      const Vec3f n = T_a_target.linear() * n_target, p = T_a_target * q - center;
      Vec6f j;
      j << p.cross(n), n;
      for (int c = 0; c < 6; ++c) {
        const float wj = w * j[c];
        for (int k = 0; k <= c; ++k) matrix(k, c) += wj * j[k];
        vector[c] += wj * r;
      }
    }
  }
};

}  // namespace

Pose motion_about(const Vec3d& center, const Vec6& step) {
  const double angle = step.head<3>().norm();
  Pose out = Pose::Identity();
  if (angle > 0.0)
    out.linear() = Eigen::AngleAxisd(angle, step.head<3>() / angle).toRotationMatrix();
  out.translation() = center + step.tail<3>() - out.linear() * center;
  return out;
}

Pose align_levels(const SurfaceLevel& a, const SurfaceLevel& b, Pose T_a_b,
                  std::span<const double> reaches_m) {
  const Vec3d center = bounds(a.samples.points).center();
  for (const double reach : reaches_m) {
    const Eigen::Isometry3f T = T_a_b.cast<float>(), back = T.inverse();
    Sums sums;
    // A point of b moves with the motion; a point of a moves the other way, as seen from b.
    sums.add(b, a, T, Eigen::Isometry3f::Identity(), true, center.cast<float>(), float(reach));
    sums.add(a, b, back, T, false, center.cast<float>(), float(reach));
    Eigen::Matrix<double, 6, 6> m =
        sums.matrix.selfadjointView<Eigen::Upper>().toDenseMatrix().cast<double>();
    const double weight = m.block<3, 3>(3, 3).trace();
    if (!(weight > 0.0)) return T_a_b;
    // So that what the pairs do not hold stays: a thousandth of what holds the rest.
    const double lever = 0.25 * bounds(a.samples.points).size().norm();
    m.diagonal().head<3>().array() += 1e-3 * weight * lever * lever;
    m.diagonal().tail<3>().array() += 1e-3 * weight;
    T_a_b = motion_about(center, m.ldlt().solve(sums.vector.cast<double>())) * T_a_b;
  }
  T_a_b.linear() = Eigen::Quaterniond(T_a_b.linear()).normalized().toRotationMatrix();
  return T_a_b;
}

}  // namespace turnscan::passes
