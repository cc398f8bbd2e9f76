#include "calibration_choice.hpp"

#include <algorithm>
#include <turnscan/turntable/check.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan::cli {

namespace {

constexpr double kDegrees = 57.29577951308232;

Result<CalibrationChoice> from_motion(const FrameSequence& sequence, const CalibrationWish& wish,
                                      const std::string& why, const RunContext& context) {
  MotionOptions options;
  options.speed_rad_s = wish.speed_rad_s;
  TURNSCAN_ASSIGN(Calibration found, calibrate_from_motion(sequence, options, {}, context));
  CalibrationChoice out;
  out.note = fmt::format(
      "{}, so the turntable was found from motion: axis to {:.2f} deg, centre to {:.2f} mm", why,
      found.axis_sigma_rad * kDegrees, found.center_sigma_m * 1e3);
  if (!found.undetermined.empty())
    out.note += fmt::format("; not determined: {}", fmt::join(found.undetermined, ", "));
  out.calibration = std::move(found);
  return out;
}

bool has_poses(const FrameSequence& sequence) {
  const auto& frames = sequence.frames();
  return std::all_of(frames.begin(), frames.end(),
                     [](const FrameInfo& f) { return f.T_table_sensor.has_value(); });
}

/// nullopt: nothing speaks against the recording's calibration.
Result<std::optional<std::string>> doubt(const FrameSequence& sequence, const RunContext& context) {
  const auto closure = measure_closure(sequence, context);
  if (!closure) {
    if (closure.error().code == ErrorCode::kMissingData) return std::nullopt;
    return tl::unexpected<Error>(closure.error());
  }
  if (!*closure || !(*closure)->bad()) return std::nullopt;
  return fmt::format(
      "with the recording's calibration the object lies {:.1f} mm and {:+.1f} deg away after one "
      "turn",
      (*closure)->shift_m * 1e3, (*closure)->turn_rad * kDegrees);
}

Result<CalibrationChoice> automatic(const FrameSequence& sequence, const CalibrationWish& wish,
                                    const RunContext& context) {
  // Motion is found for one sensor; poses of frames are not questioned.
  if (has_poses(sequence) || sequence.header().sensors.size() != 1) return CalibrationChoice();
  const auto poses = frame_poses(sequence.header(), sequence.frames(), wish.speed_rad_s);
  if (!poses) {
    auto found = from_motion(sequence, wish, "the recording has no calibration", context);
    if (found || found.error().code == ErrorCode::kCancelled) return found;
    return fail(ErrorCode::kMissingData, "{} (and from motion: {})", poses.error().message,
                found.error().message);
  }
  if (wish.table_given || wish.speed_rad_s) return CalibrationChoice();
  TURNSCAN_ASSIGN(const auto why, doubt(sequence, context));
  if (!why) return CalibrationChoice();
  auto found = from_motion(sequence, wish, *why, context);
  if (found || found.error().code == ErrorCode::kCancelled) return found;
  CalibrationChoice out;
  out.note = fmt::format("{}, but no better one was found ({})", *why, found.error().message);
  return out;
}

}  // namespace

Result<CalibrationChoice> choose_calibration(const FrameSequence& sequence,
                                             const CalibrationWish& wish,
                                             const RunContext& context) {
  if (wish.mode == "recorded") return CalibrationChoice();
  if (wish.mode == "motion")
    return from_motion(sequence, wish, "--calibration motion was given", context);
  if (wish.mode == "auto") return automatic(sequence, wish, context);
  return fail(ErrorCode::kInvalidOption,
              "--calibration {}: there is no such way; use auto, recorded or motion", wish.mode);
}

}  // namespace turnscan::cli
