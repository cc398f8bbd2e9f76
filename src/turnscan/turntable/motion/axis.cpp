#include <algorithm>
#include <cmath>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/motion/axis.hpp>

namespace turnscan::motion {

namespace {

// Deviation of a platter from perpendicular to the axis, and of its rim's centre from it. Averaged
// over a turn the plane is always perpendicular to the axis.
constexpr double kPlatterLean = 5e-4, kEccentricity_m = 1e-3;

// Of an axis of which nothing is known but that it is roughly in front of the sensor.
constexpr double kAnyTilt = 0.35, kAnyPlace_m = 0.2;

/// How a prior's knowledge of the centre and the shift along the view share what is seen of both.
struct ViewShift {
  double variance;        ///< of the centre in each direction, without that shift, m^2
  double share;           ///< of what they sum up to along the view, the shift's
  Eigen::Matrix2d along;  ///< projects onto the view, in tangent_basis(axis)
};

ViewShift view_shift(const AxisPrior& prior, const Vec3d& axis) {
  const double place = prior.platter ? platter_center_sigma_m(*prior.platter) : kAnyPlace_m;
  const double variance = place * place, shift = std::pow(prior.view_shift_m, 2);
  const auto [u, v] = tangent_basis(axis);
  const Eigen::Vector2d view(prior.to_sensor.dot(u), prior.to_sensor.dot(v));
  return {variance, shift / (shift + variance), view * view.transpose() / view.squaredNorm()};
}

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

AxisPrior axis_prior(const MotionData& data, double view_shift_m, bool use_platter) {
  return {use_platter && data.platter ? &*data.platter : nullptr, data.to_sensor, view_shift_m};
}

void add_axis_prior(const AxisPrior& prior, const Vec3d& axis, const Vec3d& center, double unit,
                    Eigen::Ref<Eigen::Matrix4d> normal, Eigen::Ref<Eigen::Vector4d> right) {
  const DetectedPlatter* platter = prior.platter;
  const double tilt = platter != nullptr ? platter_axis_sigma_rad(*platter) : kAnyTilt;
  const ViewShift view = view_shift(prior, axis);
  Eigen::Matrix4d weight = Eigen::Matrix4d::Zero();
  weight.topLeftCorner<2, 2>().diagonal().setConstant(unit / (tilt * tilt));
  weight.bottomRightCorner<2, 2>() =
      unit / view.variance * (Eigen::Matrix2d::Identity() - view.share * view.along);
  normal += weight;
  if (platter == nullptr) return;
  const auto [u, v] = tangent_basis(axis);
  const Vec3d lean = axis.cross(platter->axis);  // the rotation towards the platter's axis
  const Vec3d off = platter->center_m - center;
  right += weight * Eigen::Vector4d(lean.dot(u), lean.dot(v), off.dot(u), off.dot(v));
}

AxisEstimate without_view_shift(const AxisEstimate& apparent, const AxisPrior& prior) {
  const ViewShift view = view_shift(prior, apparent.axis);
  AxisEstimate out = apparent;
  Eigen::Matrix4d back = Eigen::Matrix4d::Identity();
  if (prior.platter != nullptr) {
    back.bottomRightCorner<2, 2>() -= view.share * view.along;
    const auto [u, v] = tangent_basis(apparent.axis);
    const Vec3d off = prior.platter->center_m - apparent.center;
    const Eigen::Vector2d step =
        view.share * (view.along * Eigen::Vector2d(off.dot(u), off.dot(v)));
    out.center += step[0] * u + step[1] * v;
  }
  out.covariance = back * apparent.covariance * back.transpose();
  out.covariance.bottomRightCorner<2, 2>() += view.share * view.variance * view.along;
  return out;
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
