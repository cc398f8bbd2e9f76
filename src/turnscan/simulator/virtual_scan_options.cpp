#include <turnscan/simulator/virtual_scan_options.hpp>

#include <turnscan/simulator/noise/noise.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMaxScanners = 64;  // maximum in a recording

template <class Options>
Result<> check_fields(const Options& options) {
  Options copy = options;
  return describe(copy).check();
}

}  // namespace

OptionTable describe(PlatterOptions& o) {
  OptionTable table;
  table.flag("platter", o.visible, "Whether there is a platter to be seen.")
      .number("platter-radius", o.radius_m, Quantity::kLength, {1e-3, 10.0},
              "Radius of the platter.")
      .number("platter-thickness", o.thickness_m, Quantity::kLength, {0.0, 1.0},
              "Thickness of the platter; 0: a disc.");
  return table;
}

OptionTable describe(MeasureOptions& o) {
  OptionTable table;
  table
      .text("noise", o.noise,
            "Depth noise: none, gaussian:SIGMA (e.g. gaussian:1.5mm), model (the formulae of the "
            "scanner's file) or physics (the sensor's own measuring, where the file names it).")
      .number("mixed-pixels", o.mixed_pixels, Quantity::kNone, {0.0, 1.0},
              "With gaussian noise: share of the silhouette's pixels that return a depth between "
              "edge and background. The other kinds mix what a pixel really sees.")
      .number("mixed-reach", o.mixed_reach_m, Quantity::kLength, {0.0, 10.0},
              "How far behind the edge such a pixel may lie.")
      .number("noise-window", o.noise_window_px, {1, kMaxNoiseWindow_px},
              "With noise = model, of structured light and stereo: side of the matching window in "
              "pixels; where windows overlap, errors are alike. 1: each pixel has its own error.")
      .number("edge-fattening", o.edge_fattening_px, Quantity::kNone, {0.0, kMaxFattening_px},
              "Of structured light and stereo: by how many pixels the foreground grows over its "
              "edges, about half the matching window at most.")
      .number("exposure", o.exposure_s, Quantity::kTime, {0.0, 10.0},
              "How long a frame takes, half of it before its time: what moves is blurred. A Kinect "
              "v2 with physics takes its nine images one after the other. 0s: an instant.")
      .number("wiggling", o.wiggling_m, Quantity::kLength, {0.0, 1.0},
              "Greatest error of a time-of-flight scanner that rises and falls with the range.")
      .number("wiggling-period", o.wiggling_period_m, Quantity::kLength, {1e-3, 100.0},
              "Range over which it rises and falls once.")
      .number("warm-up", o.warm_up_m, Quantity::kLength, {-1.0, 1.0},
              "Error by which each scanner measures too far at the first frame, while it is cold; "
              "it decays.")
      .number("warm-up-time", o.warm_up_time_s, Quantity::kTime, {1e-3, 1e6},
              "Time after which 37 % of that error is left.")
      .number("seed", o.seed, {0, 2147483647}, "Seed of all random numbers.");
  return table;
}

OptionTable describe(RecordOptions& o) {
  OptionTable table;
  table
      .choice("calibration", o.calibration, {"true", "nominal", "none"},
              "What the recording says of the turntable: where it is; where it was meant to be "
              "(without the table's offset and tilt); or nothing.")
      .flag("angles", o.angles, "Whether the recording says how far the platter has turned.")
      .flag("scan-colour", o.color, "Also record colours.")
      .number("pass", o.pass, {0, 1000000}, "Number of the pass.");
  return table;
}

Result<> check(const VirtualScanOptions& o) {
  if (o.scanners.empty() || o.scanners.size() > kMaxScanners)
    return fail(ErrorCode::kInvalidOption, "there are {} scanners; give 1 to {}", o.scanners.size(),
                kMaxScanners);
  for (const VirtualScanner& scanner : o.scanners) {
    TURNSCAN_TRY(scanner.model.check());
    TURNSCAN_TRY(check_fields(scanner.placement));
  }
  TURNSCAN_TRY(check_fields(o.platter));
  TURNSCAN_TRY(check_fields(o.table));
  TURNSCAN_TRY(check_fields(o.room));
  TURNSCAN_TRY(check_fields(o.object_move));
  TURNSCAN_TRY(check_fields(o.hand));
  TURNSCAN_TRY(check_fields(o.measure));
  TURNSCAN_TRY(check_fields(o.color_camera));
  return check_fields(o.record);
}

Result<> check_moments(const VirtualScanOptions& o, double end_s) {
  for (const VirtualScanner& scanner : o.scanners)
    TURNSCAN_TRY(check_moment("knock-at", scanner.placement.knock.happens(),
                              scanner.placement.knock.at_s, end_s));
  TURNSCAN_TRY(check_moment("hand-at", o.hand.happens(), o.hand.at_s, end_s));
  const double interval_s = 1.0 / o.motion.fps;
  if (o.measure.exposure_s > interval_s * (1.0 + 1e-12))
    return fail(ErrorCode::kInvalidOption,
                "exposure = {} is longer than from frame to frame, which is {}",
                format_quantity(o.measure.exposure_s, Quantity::kTime),
                format_quantity(interval_s, Quantity::kTime));
  return check_moment("object-move-at", o.object_move.happens(), o.object_move.at_s, end_s);
}

}  // namespace turnscan
