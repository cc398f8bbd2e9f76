#include <fmt/format.h>

#include <turnscan/core/calibration.hpp>

#include <turnscan/core/sequence_views.hpp>
namespace turnscan {

namespace {

bool same_size(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  return a.width == b.width && a.height == b.height;
}

/// Applies the calibration to header and sensors.
Result<> correct_header(const Calibration& calibration, SequenceHeader& header) {
  if (header.sensors.empty()) return {};
  header.sensors[0].T_table_sensor.reset();
  if (calibration.others.size() >= header.sensors.size())
    return fail(ErrorCode::kInvalidOption,
                "the calibration is of {} sensors, but the recording has {}; calibrate this "
                "recording",
                calibration.others.size() + 1, header.sensors.size());
  for (std::size_t i = 0; i < calibration.others.size(); ++i)
    header.sensors[i + 1].T_table_sensor = calibration.others[i].T_table_sensor;
  return correct_sensors(calibration, header.sensors);
}

Result<> correct_camera(const CameraCorrection& camera, SensorInfo& sensor) {
  if (!same_size(camera.intrinsics, sensor.intrinsics))
    return fail(ErrorCode::kInvalidOption,
                "the calibrated camera has {} x {} pixels, but the depth images {} x {}; it is of "
                "another sensor or mode",
                camera.intrinsics.width, camera.intrinsics.height, sensor.intrinsics.width,
                sensor.intrinsics.height);
  sensor.intrinsics = camera.intrinsics;
  if (camera.color_intrinsics && sensor.color_intrinsics &&
      same_size(*camera.color_intrinsics, *sensor.color_intrinsics)) {
    sensor.color_intrinsics = camera.color_intrinsics;
    sensor.T_color_sensor = camera.T_color_sensor;
  }
  return {};
}

Result<> correct_one(const std::optional<DepthCorrection>& depth,
                     const std::optional<CameraCorrection>& camera, SensorInfo& sensor) {
  if (camera) TURNSCAN_TRY(correct_camera(*camera, sensor));
  if (!depth) return {};
  sensor.depth_unit_m *= depth->scale;
  sensor.depth_bias_m = depth->bias_m;
  return {};
}

}  // namespace

Result<> correct_sensors(const Calibration& calibration, std::vector<SensorInfo>& sensors) {
  std::vector<SensorInfo> corrected = sensors;
  for (std::size_t k = 0; k < corrected.size(); ++k) {
    if (k > calibration.others.size()) break;
    const auto& depth = k == 0 ? calibration.depth : calibration.others[k - 1].depth;
    const auto& camera = k == 0 ? calibration.camera : calibration.others[k - 1].camera;
    auto done = correct_one(depth, camera, corrected[k]);
    if (!done && sensors.size() > 1)
      done.error().message = fmt::format("sensor {}: {}", k, done.error().message);
    TURNSCAN_TRY(done);
  }
  sensors = std::move(corrected);
  return {};
}

std::string_view name_of(CalibrationMethod method) {
  switch (method) {
    case CalibrationMethod::kPicked:
      return "picked points";
    case CalibrationMethod::kDetected:
      return "detected platter";
    case CalibrationMethod::kMotion:
      return "motion";
  }
  return "";
}

Result<std::unique_ptr<FrameSequence>> with_calibration(const FrameSequence& sequence,
                                                        const Calibration& calibration) {
  std::vector<FrameInfo> frames = sequence.frames();
  const auto& angles = calibration.angles_rad;
  if (!angles.empty() && angles.size() != frames.size())
    return fail(ErrorCode::kInvalidOption,
                "the calibration has {} angles, but the recording {} frames; calibrate this "
                "recording, or leave the angles out of the file",
                angles.size(), frames.size());
  SequenceHeader header = sequence.header();
  const auto recorded_speed =
      header.turntable ? header.turntable->speed_rad_s : std::optional<double>();
  header.turntable = calibration.table;
  if (!calibration.table.speed_rad_s) header.turntable->speed_rad_s = recorded_speed;
  TURNSCAN_TRY(correct_header(calibration, header));
  const bool turns = !angles.empty() || calibration.table.speed_rad_s.has_value();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (turns) frames[i].T_table_sensor.reset();
    if (!angles.empty()) {
      frames[i].angle_rad = angles[i];
    } else if (calibration.table.speed_rad_s && std::isfinite(frames[i].time_s)) {
      frames[i].angle_rad.reset();
    }
  }
  for (const std::size_t i : calibration.left_out) frames[i].status = FrameStatus::kDropped;
  auto out = std::make_unique<SequenceView>(sequence);
  out->set_header(std::move(header));
  out->set_frames(std::move(frames));
  return out;
}

}  // namespace turnscan
