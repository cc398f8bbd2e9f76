#include <turnscan/core/calibration.hpp>

namespace turnscan {

namespace {

class Calibrated : public FrameSequence {
 public:
  Calibrated(const FrameSequence& sequence, SequenceHeader header, std::vector<FrameInfo> frames)
      : sequence_(sequence), header_(std::move(header)), frames_(std::move(frames)) {}
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t position) const override {
    auto frame = sequence_.read(position);
    if (frame) frame->info = frames_.at(position);
    return frame;
  }

 private:
  const FrameSequence& sequence_;
  SequenceHeader header_;
  std::vector<FrameInfo> frames_;
};

void correct_depth(const DepthCorrection& depth, SensorInfo& sensor) {
  sensor.depth_unit_m *= depth.scale;
  sensor.depth_bias_m = depth.bias_m;
}

}  // namespace

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
  if (!header.sensors.empty()) {
    header.sensors[0].T_table_sensor.reset();
    if (calibration.depth) correct_depth(*calibration.depth, header.sensors[0]);
  }
  const bool turns = !angles.empty() || calibration.table.speed_rad_s.has_value();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (turns) frames[i].T_table_sensor.reset();
    if (!angles.empty()) {
      frames[i].angle_rad = angles[i];
    } else if (calibration.table.speed_rad_s && std::isfinite(frames[i].time_s)) {
      frames[i].angle_rad.reset();
    }
  }
  return std::make_unique<Calibrated>(sequence, std::move(header), std::move(frames));
}

}  // namespace turnscan
