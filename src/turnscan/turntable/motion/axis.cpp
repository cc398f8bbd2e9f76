#include <algorithm>
#include <cmath>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/motion/axis.hpp>

namespace turnscan::motion {

namespace {

// Deviation of a platter from perpendicular to the axis, and of its rim's centre from it. Averaged
// over a turn the plane is always perpendicular to the axis.
constexpr double kPlatterLean = 5e-4, kEccentricity_m = 1e-3;

/// The tilts and shifts from one axis to another, at the height of the first one's centre.
Eigen::Vector4d way_between(const AxisEstimate& from, const AxisEstimate& to) {
  const auto [u, v] = tangent_basis(from.axis);
  const Vec3d lean = from.axis.cross(to.axis), off = from.center - to.center;
  const double along = from.axis.dot(off) / from.axis.dot(to.axis);
  const Vec3d shift = to.center + along * to.axis - from.center;
  return {lean.dot(u), lean.dot(v), shift.dot(u), shift.dot(v)};
}

/// Clamps negative eigenvalues, since estimated covariances of nested data may be inconsistent.
Eigen::Matrix4d without_negative(const Eigen::Matrix4d& matrix) {
  const auto eigen = estimation::symmetric_eigen(matrix);
  return eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
}

}  // namespace

double platter_axis_sigma_rad(const DetectedPlatter& platter) {
  return std::hypot(platter.axis_sigma_rad, kPlatterLean);
}

double platter_center_sigma_m(const DetectedPlatter& platter) {
  return std::hypot(platter.center_sigma_m, kEccentricity_m);
}

void add_axis_prior(const DetectedPlatter* platter, const Vec3d& axis, const Vec3d& center,
                    double unit, Eigen::Ref<Eigen::Matrix4d> normal,
                    Eigen::Ref<Eigen::Vector4d> right) {
  const double tilt = platter != nullptr ? platter_axis_sigma_rad(*platter) : 0.35;
  const double shift = platter != nullptr ? platter_center_sigma_m(*platter) : 0.2;
  const Eigen::Vector4d weight =
      unit * Eigen::Vector4d(1.0 / (tilt * tilt), 1.0 / (tilt * tilt), 1.0 / (shift * shift),
                             1.0 / (shift * shift));
  normal.diagonal() += weight;
  if (platter == nullptr) return;
  const auto [u, v] = tangent_basis(axis);
  const Vec3d lean = axis.cross(platter->axis);  // the rotation towards the platter's axis
  const Vec3d off = platter->center_m - center;
  right += weight.cwiseProduct(Eigen::Vector4d(lean.dot(u), lean.dot(v), off.dot(u), off.dot(v)));
}

std::pair<Vec3d, Vec3d> tangent_basis(const Vec3d& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3d u = n.cross(Vec3d::Unit(least)).normalized();
  return {u, n.cross(u)};
}

std::pair<double, double> move_axis(const Eigen::Vector4d& step, Vec3d& axis, Vec3d& center) {
  const auto [u, v] = tangent_basis(axis);
  const Vec3d turn = step[0] * u + step[1] * v, shift = step[2] * u + step[3] * v;
  const double size = std::min(turn.norm(), 0.2);
  if (size > 0.0) axis = (Eigen::AngleAxisd(size, turn.normalized()) * axis).normalized();
  center += shift * std::min(1.0, 0.05 / std::max(shift.norm(), 1e-12));
  return {size, shift.norm()};
}

AxisEstimate combine_nested(const AxisEstimate& all, const AxisEstimate& part,
                            const Eigen::Matrix4d& bias) {
  // Tilts and shifts differ by orders of magnitude.
  const Eigen::Vector4d unit = bias.diagonal().cwiseSqrt();
  if (!(unit.minCoeff() > 0.0)) return all;
  const Eigen::Vector4d per = unit.cwiseInverse();
  const Eigen::Matrix4d own = per.asDiagonal() * bias * per.asDiagonal();
  const Eigen::Matrix4d noise =
      without_negative(per.asDiagonal() * (part.covariance - all.covariance) * per.asDiagonal());
  const Eigen::Matrix4d between = noise + own;
  const Eigen::Vector4d way = per.asDiagonal() * way_between(all, part);
  const Eigen::Vector4d step = unit.asDiagonal() * own * estimation::solve_ldlt(between, way);
  AxisEstimate out = all;
  move_axis(step, out.axis, out.center);
  out.covariance +=
      unit.asDiagonal() * (own - own * estimation::solve_ldlt(between, own)) * unit.asDiagonal();
  return out;
}

}  // namespace turnscan::motion
