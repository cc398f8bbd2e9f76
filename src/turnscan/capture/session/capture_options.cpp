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
                "turns, seconds, frames and until-stopped are different ends of a recording; give "
                "one of them");
  if (!has_motor && options.stops.stops)
    return fail(ErrorCode::kInvalidOption,
                "stops: there is no motor that could make them; give it");
  if (has_motor && !options.speed_rad_s)
    return fail(ErrorCode::kInvalidOption,
                "speed: it is not known how fast the motor is to turn; give it");
  if (options.stops.stops && (limits.seconds || limits.frames || limits.until_stopped))
    return fail(ErrorCode::kInvalidOption,
                "stops: they end with the turns; leave out other limits");
  return {};
}

OptionTable describe(CaptureLimits& o) {
  OptionTable table;
  table
      .number("turns", o.turns, Quantity::kNone, {0.01, 1000.0},
              "Record so many turns of the table; 1 unless another end is given")
      .number("seconds", o.seconds, Quantity::kNone, {0.01, 1e6},
              "Record for so many seconds; turnscan scan waits no longer than that for an object, "
              "either")
      .number("frames", o.frames, {1, 1000000}, "Record so many frames of each sensor")
      .flag("until-stopped", o.until_stopped, "Record until Ctrl-C")
      .number("overlap", o.overlap_rad, Quantity::kAngle, {0.0, kTurn},
              "Added to turns, so that the first view is seen once more")
      .number("device-timeout", o.device_timeout_s, Quantity::kTime, {0.1, 3600.0},
              "Without a frame, after which the sensor counts as lost");
  return table;
}

OptionTable describe(CaptureCrop& o) {
  OptionTable table;
  table
      .flag("crop", o.enabled,
            "Record only what is on and just around the platter; needs the turntable's place")
      .number("crop-below", o.below_m, Quantity::kLength, {-1.0, 1.0},
              "What is kept below the platter's surface")
      .number("crop-beyond", o.beyond_m, Quantity::kLength, {-1.0, 1.0},
              "What is kept outside the platter's rim")
      .number("crop-height", o.height_m, Quantity::kLength, {0.001, 10.0},
              "What is kept above the platter's surface");
  return table;
}

OptionTable describe(CaptureStops& o) {
  OptionTable table;
  table
      .number("stops", o.stops, {2, 100000},
              "Stop the table so often in one turn and record while it stands")
      .number("stop-frames", o.averaged, {1, 1000}, "Frames at each stop, whose mean is recorded")
      .number("settle", o.settle_s, Quantity::kTime, {0.0, 60.0},
              "That the table stands before frames are taken");
  return table;
}

}  // namespace turnscan
