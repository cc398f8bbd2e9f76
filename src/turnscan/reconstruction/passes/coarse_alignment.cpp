#include <turnscan/reconstruction/passes/coarse_alignment.hpp>

#include <array>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/se3.hpp>

namespace turnscan::passes {

namespace {

constexpr float kAlignCos = 0.6f;

/// A difference of colours by the spread has the weight of this distance.
constexpr float kColorLength_m = 0.003f;

using Four = Eigen::Array4f;  // x, y, z, 0

Four four(const Vec3f& v) { return {v.x(), v.y(), v.z(), 0.0f}; }
float dot(const Four& one, const Four& other) {
  return one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
}

/// Moves single points: what Eigen makes of that is not inlined, and took most of the time.
struct Motion {
  Four x, y, z, shift;

  explicit Motion(const Eigen::Isometry3f& T)
      : x(four(T.linear().col(0))),
        y(four(T.linear().col(1))),
        z(four(T.linear().col(2))),
        shift(four(T.translation())) {}
  Four turned(const Four& v) const { return x * v[0] + y * v[1] + z * v[2]; }
  Four moved(const Four& p) const { return turned(p) + shift; }
};

/// Sums of weighted squares, in the frame of a, about a center.
class Sums {
 public:
  Sums(const Vec3f& center, float reach, float color_spread)
      : center_(four(center)), reach_(reach), color_spread_(color_spread) {
    for (auto& row : rows_) row.fill(Four::Zero());
  }

  /// Adds pairs of the source's points, of which each stride-th is used, with the target's nearest.
  /// sign: -1 if the target moves.
  void add(const SurfaceLevel& source, const SurfaceLevel& target, const Motion& T_target_source,
           const Motion& T_a_target, float sign, std::size_t stride) {
    const float squared_reach = reach_ * reach_;
    for (std::size_t i = 0; i < source.samples.size(); i += stride) {
      const Four q = T_target_source.moved(four(source.samples.points[i]));
      const std::uint32_t near = target.nearest(q[0], q[1], q[2]);
      if (near == NearestGrid::kNone) continue;
      const Four apart = four(target.samples.points[near]) - q;
      if (dot(apart, apart) > squared_reach) continue;
      const Four nq = T_target_source.turned(four(source.samples.normals[i]));
      const Four np = four(target.samples.normals[near]);
      if (dot(nq, np) < kAlignCos) continue;
      const Four between = np + nq, n = between / std::sqrt(dot(between, between));
      const float r = dot(n, apart) * sign, u = 1.0f - r * r / squared_reach;
      const float w = u * u * source.samples.areas[i];
      const Four p = T_a_target.moved(q) - center_;
      add_row(p, T_a_target.turned(n), w, r);
      if (color_spread_ > 0.0f)
        add_colors(source, i, target, near, T_target_source, T_a_target, apart, p, w, sign);
    }
  }

  /// Of the rotation vector and the translation that follow the motion.
  estimation::Matrix6d matrix() const {
    estimation::Matrix6d out;
    for (int row = 0; row < 6; ++row)
      for (int k = row; k < 6; ++k) out(row, k) = out(k, row) = at(row, k);
    return out;
  }
  estimation::Vector6d right() const {
    estimation::Vector6d out;
    for (int row = 0; row < 6; ++row) out[row] = at(row, 6);
    return out;
  }

 private:
  double at(int row, int k) const {
    return double(rows_[std::size_t(row)][std::size_t(k / 4)][k % 4]);
  }

  void add_row(const Four& p, const Four& n, float w, float r) {
    const float x = p[1] * n[2] - p[2] * n[1], y = p[2] * n[0] - p[0] * n[2],
                z = p[0] * n[1] - p[1] * n[0];
    const Four first{x, y, z, n[0]}, second{n[1], n[2], r, 0.0f};
    const std::array<float, 6> row{x, y, z, n[0], n[1], n[2]};
    for (std::size_t k = 0; k < 6; ++k) {
      rows_[k][0] += (w * row[k]) * first;
      rows_[k][1] += (w * row[k]) * second;
    }
  }

  /// The gradient of a channel takes the place of the normal.
  void add_colors(const SurfaceLevel& source, std::size_t i, const SurfaceLevel& target,
                  std::uint32_t near, const Motion& T_target_source, const Motion& T_a_target,
                  const Four& apart, const Four& p, float w, float sign) {
    std::array<Four, 3> gradient;
    std::array<float, 3> left;
    float squared = 0.0f;
    for (int c = 0; c < 3; ++c) {
      const auto channel = std::size_t(c);
      gradient[channel] = 0.5f * (four(target.color_gradients[near].row(c)) +
                                  T_target_source.turned(four(source.color_gradients[i].row(c))));
      left[channel] = source.samples.colors[i][c] - target.samples.colors[near][c] +
                      dot(gradient[channel], apart);
      squared += left[channel] * left[channel];
    }
    const float u = 1.0f - squared / (4.0f * color_spread_ * color_spread_);
    if (!(u > 0.0f)) return;  // also for NaN
    const float per_color = kColorLength_m / color_spread_;
    for (std::size_t c = 0; c < 3; ++c)
      add_row(p, T_a_target.turned(gradient[c]), w * u * u * per_color * per_color, sign * left[c]);
  }

  Four center_;
  float reach_, color_spread_;
  /// Rows of the normal equations: of the matrix, then the right side.
  std::array<std::array<Four, 2>, 6> rows_;
};

}  // namespace

Pose align_levels(const SurfaceLevel& a, const SurfaceLevel& b, Pose T_a_b,
                  std::span<const double> reaches_m, float color_spread, std::size_t stride) {
  const Box box = bounds(a.samples.points);
  const Vec3d center = box.center();
  const Motion none(Eigen::Isometry3f::Identity());
  for (const double reach : reaches_m) {
    const Eigen::Isometry3f T = T_a_b.cast<float>();
    const Motion there(T), back(T.inverse());
    Sums sums(center.cast<float>(), float(reach), color_spread);
    // A point of b moves with the motion; a point of a moves the other way, as seen from b.
    sums.add(b, a, there, none, 1.0f, stride);
    sums.add(a, b, back, there, -1.0f, stride);
    estimation::Matrix6d m = sums.matrix();
    const double weight = m.block<3, 3>(3, 3).trace();
    if (!(weight > 0.0)) return T_a_b;
    // Fixes directions that the pairs do not constrain, with a thousandth of the constraint of the
    // rest.
    const double lever = 0.25 * box.size().norm();
    m.diagonal().head<3>().array() += 1e-3 * weight * lever * lever;
    m.diagonal().tail<3>().array() += 1e-3 * weight;
    T_a_b = estimation::exp_about(center, estimation::solve_ldlt(m, sums.right())) * T_a_b;
  }
  return estimation::orthonormalised(T_a_b);
}

}  // namespace turnscan::passes
