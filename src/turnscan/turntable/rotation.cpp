#include <turnscan/turntable/rotation.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

Result<double> angle_of(const FrameInfo& frame, const FrameInfo& first,
                        std::optional<double> stated_speed, std::optional<double> recorded_speed) {
  const bool timed = std::isfinite(frame.time_s);
  const double t0 = first.time_s;
  if (frame.stretch != first.stretch && !(frame.angle_rad && !stated_speed))
    return fail(ErrorCode::kMissingData,
                "frame {} was taken after the recording had been resumed, and how far the table "
                "turned meanwhile has to be found from motion; use --calibration auto",
                frame.index);
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

FramePoser::FramePoser(const SequenceHeader& header, std::optional<double> speed_rad_s)
    : header_(&header), speed_rad_s_(speed_rad_s), sensors_(header.sensors.size()) {}

Result<Pose> FramePoser::operator()(const FrameInfo& frame) {
  if (!first_) first_ = frame;
  if (frame.T_table_sensor) return *frame.T_table_sensor;
  const auto recorded_speed =
      header_->turntable ? header_->turntable->speed_rad_s : std::optional<double>();
  TURNSCAN_ASSIGN(const double angle, angle_of(frame, *first_, speed_rad_s_, recorded_speed));
  source_ = frame.angle_rad && !speed_rad_s_ ? PoseSource::kAngles : PoseSource::kTimesAndSpeed;
  auto& sensor = sensors_.at(frame.sensor);
  if (!sensor) {
    TURNSCAN_ASSIGN(sensor, sensor_pose(*header_, frame.sensor));
  }
  return Pose(rotation_about_y(-angle) * *sensor);
}

Result<FramePoses> frame_poses(const SequenceHeader& header, const std::vector<FrameInfo>& frames,
                               std::optional<double> speed_rad_s) {
  FramePoses out;
  FramePoser poser(header, speed_rad_s);
  for (const FrameInfo& frame : frames) {
    TURNSCAN_ASSIGN(const Pose pose, poser(frame));
    out.T_table_sensor.push_back(pose);
  }
  out.source = poser.source();
  return out;
}

}  // namespace turnscan
