#include <turnscan/reconstruction/passes/coarse_alignment.hpp>

#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/se3.hpp>

namespace turnscan::passes {

namespace {

constexpr float kAlignCos = 0.6f;

using Vec6f = Eigen::Matrix<float, 6, 1>;

/// A difference of colours by the spread has the weight of this distance.
constexpr float kColorLength_m = 0.003f;

/// Sums of weighted squares, in the frame of a, about a center.
struct Sums {
  float color_spread = 0.0f;
  Eigen::Matrix<float, 6, 6> matrix = Eigen::Matrix<float, 6, 6>::Zero();
  Vec6f vector = Vec6f::Zero();

  /// Adds pairs of the source's points with the target's nearest. back: from the target's frame to
  /// a's.
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
      add_row(p, n, w, r);
      if (color_spread > 0.0f)
        add_colors(source, i, target, near, T_target_source, T_a_target, p, w,
                   source_moves ? 1.0f : -1.0f);
    }
  }

 private:
  void add_row(const Vec3f& p, const Vec3f& n, float w, float r) {
    Vec6f j;
    j << p.cross(n), n;
    for (int c = 0; c < 6; ++c) {
      const float wj = w * j[c];
      for (int k = 0; k <= c; ++k) matrix(k, c) += wj * j[k];
      vector[c] += wj * r;
    }
  }

  /// The gradient of a channel takes the place of the normal.
  void add_colors(const SurfaceLevel& source, std::size_t i, const SurfaceLevel& target,
                  std::uint32_t near, const Eigen::Isometry3f& T_target_source,
                  const Eigen::Isometry3f& T_a_target, const Vec3f& p, float w, float sign) {
    const Vec3f apart = target.samples.points[near] - T_target_source * source.samples.points[i];
    const Eigen::Matrix3f gradient =
        0.5f * (target.color_gradients[near] +
                source.color_gradients[i] * T_target_source.linear().transpose());
    const Vec3f left = source.samples.colors[i] - target.samples.colors[near] + gradient * apart;
    const float u = 1.0f - left.squaredNorm() / (4.0f * color_spread * color_spread);
    if (!(u > 0.0f)) return;  // also for NaN
    const float per_color = kColorLength_m / color_spread;
    for (int channel = 0; channel < 3; ++channel)
      add_row(p, T_a_target.linear() * gradient.row(channel).transpose(),
              w * u * u * per_color * per_color, sign * left[channel]);
  }
};

}  // namespace

Pose align_levels(const SurfaceLevel& a, const SurfaceLevel& b, Pose T_a_b,
                  std::span<const double> reaches_m, float color_spread) {
  const Vec3d center = bounds(a.samples.points).center();
  for (const double reach : reaches_m) {
    const Eigen::Isometry3f T = T_a_b.cast<float>(), back = T.inverse();
    Sums sums;
    sums.color_spread = color_spread;
    // A point of b moves with the motion; a point of a moves the other way, as seen from b.
    sums.add(b, a, T, Eigen::Isometry3f::Identity(), true, center.cast<float>(), float(reach));
    sums.add(a, b, back, T, false, center.cast<float>(), float(reach));
    estimation::Matrix6d m =
        sums.matrix.selfadjointView<Eigen::Upper>().toDenseMatrix().cast<double>();
    const double weight = m.block<3, 3>(3, 3).trace();
    if (!(weight > 0.0)) return T_a_b;
    // Fixes directions that the pairs do not constrain, with a thousandth of the constraint of the
    // rest.
    const double lever = 0.25 * bounds(a.samples.points).size().norm();
    m.diagonal().head<3>().array() += 1e-3 * weight * lever * lever;
    m.diagonal().tail<3>().array() += 1e-3 * weight;
    const estimation::Vector6d right = sums.vector.cast<double>();
    T_a_b = estimation::exp_about(center, estimation::solve_ldlt(m, right)) * T_a_b;
  }
  return estimation::orthonormalised(T_a_b);
}

}  // namespace turnscan::passes
