#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

Result<Pose> table_from_sensor(const TurntableInfo& turntable) {
  const Vec3d& o = turntable.center_m;
  if (!turntable.axis.allFinite() || !o.allFinite() || !(turntable.axis.norm() > 1e-9))
    return fail(ErrorCode::kFormat, "turntable: axis or centre is not finite, or the axis is zero");
  const Vec3d y = turntable.axis.normalized();
  Vec3d x = y.cross(o);
  // If the centre is on the line of the axis through the sensor, the direction of X is undefined.
  if (x.norm() < 1e-9 * std::max(1.0, o.norm())) {
    int farthest = 0;
    y.cwiseAbs().minCoeff(&farthest);
    x = Vec3d::Unit(farthest) - y * y[farthest];
  }
  x.normalize();
  Pose pose = Pose::Identity();
  pose.linear().row(0) = x;
  pose.linear().row(1) = y;
  pose.linear().row(2) = x.cross(y);
  pose.translation() = -(pose.linear() * o);
  return pose;
}

Result<Pose> sensor_pose(const SequenceHeader& header, std::size_t sensor) {
  if (sensor < header.sensors.size() && header.sensors[sensor].T_table_sensor)
    return *header.sensors[sensor].T_table_sensor;
  if (header.turntable && sensor == 0) return table_from_sensor(*header.turntable);
  return fail(ErrorCode::kMissingData,
              "sensor {}: nothing says where the turntable is; import with --turntable-axis and "
              "--turntable-center",
              sensor);
}

}  // namespace turnscan
