#include <fmt/format.h>

#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/placement/disturbance_text.hpp>

namespace turnscan {

namespace placement {

namespace {

/// "15.3 s", or "frame 460" if there are no times.
std::string moment_of(const FrameSequence& sequence, std::size_t position) {
  const auto& frames = sequence.frames();
  const FrameInfo& frame = frames[std::min(position, frames.size() - 1)];
  if (std::isfinite(frame.time_s)) return fmt::format("{:.1f} s", frame.time_s);
  return fmt::format("frame {}", frame.index);
}

/// Motion of a model's last frame by a step or a drift, as rotation and as the translation of a
/// point.
struct Move {
  double turn_deg = 0.0, shift_mm = 0.0;
};

Move move_of(const Twist& twist, double lever_m) {
  return {twist.head<3>().norm() / lever_m * kDegreesPerRadian, twist.tail<3>().norm() * 1e3};
}

std::string move_text(const Move& move) {
  if (move.turn_deg < 0.2) return fmt::format("by {:.1f} mm", move.shift_mm);
  return fmt::format("by {:.1f} mm and {:.1f} deg", move.shift_mm, move.turn_deg);
}

std::string speed_text(const FrameSequence& sequence, const ModelFrames& frames, double more_rad) {
  const double believed = frames.scene.turn_rad, seen = believed + more_rad;
  const auto& infos = sequence.frames();
  const double seconds = infos.back().time_s - infos.front().time_s;
  const std::string text =
      fmt::format("the table turned {:.1f} % {} than stated", std::abs(more_rad / believed) * 100.0,
                  seen / believed > 1.0 ? "faster" : "slower");
  if (!(seconds > 0.0)) return text;
  return fmt::format("{}, by {:.4f} deg/s", text, seen / seconds * kDegreesPerRadian);
}

/// turn_rad: of the table, or its speed, for the direction.
std::string slip_text(double more_rad, double turn_rad, const std::string& at) {
  return fmt::format("the table slipped {} by {:.1f} deg at {}",
                     more_rad * turn_rad > 0.0 ? "ahead" : "back",
                     std::abs(more_rad) * kDegreesPerRadian, at);
}

std::string wobble_text(const DisturbanceModel& model, double lever_m) {
  return fmt::format("the table wobbles by {:.1f} deg, {:g} times a turn",
                     wobble_rad(model, lever_m) * kDegreesPerRadian, model.cycles);
}

DisturbanceKind kind_of(ModelKind kind) {
  switch (kind) {
    case ModelKind::kCalibration:
      return DisturbanceKind::kCalibration;
    case ModelKind::kSpeed:
      return DisturbanceKind::kSpeed;
    case ModelKind::kSlip:
      return DisturbanceKind::kSlip;
    case ModelKind::kHalt:
      return DisturbanceKind::kHalt;
    case ModelKind::kObject:
      return DisturbanceKind::kObject;
    case ModelKind::kSensor:
      return DisturbanceKind::kSensor;
    default:
      return DisturbanceKind::kWobble;
  }
}

std::string text_of(const FrameSequence& sequence, const ModelFrames& frames,
                    const DisturbanceModel& model) {
  const double lever = frames.scene.lever_m, turn = frames.scene.turn_rad;
  const double more = model.values[0] / lever;
  const std::string at = moment_of(sequence, model.first);
  switch (model.kind) {
    case ModelKind::kCalibration:
      return "the sensor stands elsewhere than the calibration has it, " +
             move_text(move_of(model.values, lever));
    case ModelKind::kSpeed:
      return speed_text(sequence, frames, more);
    case ModelKind::kSlip:
      return slip_text(more, turn, at);
    case ModelKind::kHalt:
      return fmt::format("the table slowed down or stopped between {} and {}",
                         moment_of(sequence, model.last), at);
    case ModelKind::kObject:
      return fmt::format("the object moved {} at {}", move_text(move_of(model.values, lever)), at);
    case ModelKind::kSensor:
      return fmt::format("the sensor was knocked at {}: what it sees moved {}", at,
                         move_text(move_of(model.values, lever)));
    default:
      return wobble_text(model, lever);
  }
}

}  // namespace

Disturbance tell(const FrameSequence& sequence, const ModelFrames& frames,
                 const std::vector<DisturbanceModel>& models, std::size_t which) {
  const DisturbanceModel& model = models[which];
  Disturbance out;
  out.kind = kind_of(model.kind);
  out.first_frame = model.kind == ModelKind::kHalt ? model.last + 1 : model.first;
  out.last_frame = frames.all.size() - 1;
  for (const ModelFrame& frame : frames.all) {
    const Twist moved = basis_of(model, frame, frames.scene) * model.values;
    out.size_m = std::max(out.size_m, moved.norm());
  }
  out.text = text_of(sequence, frames, model);
  return out;
}

Disturbance tell_hidden(const FrameSequence& sequence, std::size_t first, std::size_t last) {
  Disturbance out;
  out.kind = DisturbanceKind::kHidden;
  out.first_frame = first;
  out.last_frame = last;
  out.text = fmt::format("something reached in front of the object from {} to {}",
                         moment_of(sequence, first), moment_of(sequence, last));
  return out;
}

}  // namespace placement

Disturbance disturbance_of(const TableSlip& slip, const Calibration& calibration,
                           const FrameSequence& recording) {
  Disturbance out;
  out.kind = DisturbanceKind::kSlip;
  out.first_frame = slip.first_frame;
  out.last_frame = recording.frames().size() - 1;
  out.size_m = std::abs(slip.turn_rad) * placement::ModelScene().lever_m;
  out.text = placement::slip_text(slip.turn_rad, calibration.table.speed_rad_s.value_or(1.0),
                                  placement::moment_of(recording, slip.first_frame));
  return out;
}

}  // namespace turnscan
