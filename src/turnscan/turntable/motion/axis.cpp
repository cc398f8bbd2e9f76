#include <algorithm>
#include <cmath>
#include <turnscan/turntable/motion/axis.hpp>

namespace turnscan::motion {

namespace {

// How far a platter may lie from square to the axis, and its rim's centre from it. In the mean
// over a turn the plane is square to the axis wherever it is.
constexpr double kPlatterLean = 5e-4, kEccentricity_m = 1e-3;

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
  const Vec3d lean = axis.cross(platter->axis);  // the turn that would get there
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

}  // namespace turnscan::motion
