#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/placement/disturbance_model.hpp>

namespace turnscan::placement {

namespace {

/// The twist of a rotation about an axis through `at` (table frame); rotation times lever.
Twist rotation_twist(const Vec3d& turn, const Vec3d& at, const ModelScene& scene) {
  Twist out;
  out.head<3>() = turn;
  out.tail<3>() = turn.cross(scene.middle - at) / scene.lever_m;
  return out;
}

/// A rotation of the platter by one more lever's length moves the frame back by as much.
Twist turn_twist(const ModelScene& scene) {
  return rotation_twist(-Vec3d::UnitY(), Vec3d::Zero(), scene);
}

/// Six unknowns: the sensor rotates about the object's middle, and translates; sensor frame.
Basis sensor_basis(const ModelFrame& frame, const ModelScene& scene) {
  const Eigen::Matrix3d R = frame.T_table_sensor.linear();
  const Vec3d at = frame.T_table_sensor * scene.middle_sensor;
  Basis out(6, 6);
  for (int k = 0; k < 3; ++k) {
    out.col(k) = rotation_twist(R.col(k), at, scene);
    out.col(3 + k).setZero();
    out.col(3 + k).tail<3>() = R.col(k);
  }
  return out;
}

/// The platter tilts about two horizontal axes and translates in three directions, all as cosine
/// and sine.
Basis wobble_basis(double cycles, const ModelFrame& frame, const ModelScene& scene) {
  const double way = cycles * frame.turned_rad;
  const Eigen::Matrix3d R = rotation_about_y(-frame.turned_rad).linear();
  Basis out(6, 10);
  for (int k = 0; k < 2; ++k) {
    const double wave = k == 0 ? std::cos(way) : std::sin(way);
    out.col(5 * k) = wave * rotation_twist(R.col(0), Vec3d::Zero(), scene);
    out.col(5 * k + 1) = wave * rotation_twist(R.col(2), Vec3d::Zero(), scene);
    for (int axis = 0; axis < 3; ++axis) {
      out.col(5 * k + 2 + axis).setZero();
      out.col(5 * k + 2 + axis).tail<3>() = wave * R.col(axis);
    }
  }
  return out;
}

/// Degree to which a frame is affected: 0 before the frames of the model, 1 after them.
double ramp_of(const DisturbanceModel& model, std::size_t position) {
  if (position >= model.first) return 1.0;
  if (model.kind != ModelKind::kHalt || position <= model.last) return 0.0;
  return double(position - model.last) / double(model.first - model.last);
}

}  // namespace

Eigen::Index unknowns_of(ModelKind kind) {
  switch (kind) {
    case ModelKind::kSpeed:
    case ModelKind::kSlip:
    case ModelKind::kHalt:
      return 1;
    case ModelKind::kWobble:
      return 10;
    default:
      return 6;
  }
}

Basis basis_of(const DisturbanceModel& model, const ModelFrame& frame, const ModelScene& scene) {
  const double ramp = ramp_of(model, frame.position);
  switch (model.kind) {
    case ModelKind::kCalibration:
      return sensor_basis(frame, scene);
    case ModelKind::kSpeed:
      return turn_twist(scene) * (frame.turned_rad / scene.turn_rad);
    case ModelKind::kSlip:
    case ModelKind::kHalt:
      return turn_twist(scene) * ramp;
    case ModelKind::kObject:
      return Matrix6d::Identity() * ramp;
    case ModelKind::kSensor:
      return sensor_basis(frame, scene) * ramp;
    case ModelKind::kWobble:
      return wobble_basis(model.cycles, frame, scene);
  }
  return Basis::Zero(6, 0);
}

double wobble_rad(const DisturbanceModel& model, double lever_m) {
  const Eigen::VectorXd& v = model.values;
  return std::sqrt(0.5 * (v.segment<2>(0).squaredNorm() + v.segment<2>(5).squaredNorm())) / lever_m;
}

}  // namespace turnscan::placement
