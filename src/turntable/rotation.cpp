#include <turnscan/turntable/rotation.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

Result<double> angle_of(const FrameInfo& frame, double t0, std::optional<double> stated_speed,
                        std::optional<double> recorded_speed) {
  const bool timed = std::isfinite(frame.time_s);
  if (timed && stated_speed) return *stated_speed * (frame.time_s - t0);
  if (frame.angle_rad) return *frame.angle_rad;
  if (timed && recorded_speed) return *recorded_speed * (frame.time_s - t0);
  if (timed)
    return fail(ErrorCode::kMissingData,
                "frame {} has a time but neither angle nor pose, and the turntable's speed is not "
                "known; give --speed, e.g. --speed 10.4478deg/s",
                frame.index);
  return fail(ErrorCode::kMissingData,
              "frame {} has no time, angle or pose; import with a list of angles", frame.index);
}

}  // namespace

Result<FramePoses> frame_poses(const SequenceHeader& header, const std::vector<FrameInfo>& frames,
                               std::optional<double> speed_rad_s) {
  FramePoses out;
  const auto recorded_speed =
      header.turntable ? header.turntable->speed_rad_s : std::optional<double>();
  const double t0 = frames.empty() ? 0.0 : frames.front().time_s;
  std::vector<std::optional<Pose>> sensors(header.sensors.size());
  for (const FrameInfo& frame : frames) {
    if (frame.T_table_sensor) {
      out.T_table_sensor.push_back(*frame.T_table_sensor);
      continue;
    }
    TURNSCAN_ASSIGN(const double angle, angle_of(frame, t0, speed_rad_s, recorded_speed));
    out.source = frame.angle_rad && !speed_rad_s ? PoseSource::kAngles : PoseSource::kTimesAndSpeed;
    auto& sensor = sensors.at(frame.sensor);
    if (!sensor) {
      TURNSCAN_ASSIGN(sensor, sensor_pose(header, frame.sensor));
    }
    out.T_table_sensor.push_back(rotation_about_y(-angle) * *sensor);
  }
  return out;
}

}  // namespace turnscan
