#include <turnscan/capture/session/capture_options.hpp>
#include <turnscan/core/angles.hpp>

namespace turnscan {

Result<> session::check_capture_options(const CaptureOptions& options, bool has_motor) {
  CaptureOptions copy = options;
  TURNSCAN_TRY(describe(copy.limits).check());
  TURNSCAN_TRY(describe(copy.crop).check());
  TURNSCAN_TRY(describe(copy.stops).check());
  const CaptureLimits& limits = options.limits;
  const int given = int(limits.turns.has_value()) + int(limits.seconds.has_value()) +
                    int(limits.frames.has_value()) + int(limits.until_stopped);
  if (given > 1)
    return fail(ErrorCode::kInvalidOption,
                "turns, seconds, frames and until-stopped exclude each other; give one of them");
  if (!has_motor && options.stops.stops)
    return fail(ErrorCode::kInvalidOption, "stops: there is no motor to make them; give one");
  if (has_motor && !options.speed_rad_s)
    return fail(ErrorCode::kInvalidOption, "speed: a motor needs one; give it");
  if (options.stops.stops && (limits.seconds || limits.frames || limits.until_stopped))
    return fail(ErrorCode::kInvalidOption,
                "stops: the recording ends with the turns; leave out other limits");
  return {};
}

OptionTable describe(CaptureLimits& o) {
  OptionTable table;
  table
      .number("turns", o.turns, Quantity::kNone, {0.01, 1000.0},
              "Number of turns to record; 1 unless another limit is given")
      .number("seconds", o.seconds, Quantity::kNone, {0.01, 1e6},
              "Seconds to record; turnscan scan also waits at most this long for an object")
      .number("frames", o.frames, {1, 1000000}, "Number of frames to record of each sensor")
      .flag("until-stopped", o.until_stopped, "Record until Ctrl-C")
      .number("overlap", o.overlap_rad, Quantity::kAngle, {0.0, kTurn},
              "Angle added to the turns, so that the first view is seen again")
      .number("device-timeout", o.device_timeout_s, Quantity::kTime, {0.1, 3600.0},
              "Time without a frame after which the sensor counts as lost");
  return table;
}

OptionTable describe(CaptureCrop& o) {
  OptionTable table;
  table
      .flag("crop", o.enabled,
            "Record only what is on and just around the platter; needs the turntable's pose")
      .number("crop-below", o.below_m, Quantity::kLength, {-1.0, 1.0},
              "Distance below the platter's surface that is kept")
      .number("crop-beyond", o.beyond_m, Quantity::kLength, {-1.0, 1.0},
              "Distance outside the platter's rim that is kept")
      .number("crop-height", o.height_m, Quantity::kLength, {0.001, 10.0},
              "Height above the platter's surface that is kept");
  return table;
}

OptionTable describe(CaptureStops& o) {
  OptionTable table;
  table
      .number("stops", o.stops, {2, 100000},
              "Number of stops in one turn; frames are recorded while the table stands")
      .number("stop-frames", o.averaged, {1, 1000}, "Frames at each stop, whose mean is recorded")
      .number("settle", o.settle_s, Quantity::kTime, {0.0, 60.0},
              "Time that the table stands before frames are taken");
  return table;
}

}  // namespace turnscan
