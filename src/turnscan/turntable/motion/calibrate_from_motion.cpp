#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/motion/motion_result.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>

namespace turnscan::motion {

namespace {

/// A less accurate axis is rejected.
constexpr double kLargestAxisSigma = 1.0 * kRadiansPerDegree;
/// Lower limits for a platter that is verified by the object's own rotation (DetectOptions).
constexpr double kMinAgreement = 0.65, kMinConfidence = 0.5;

struct Attempt {
  MotionData data;
  RefinedMotion refined;
};

/// started: set once a motion to start from was found.
Result<Attempt> attempt(const FrameSequence& sequence, const FromMotionOptions& options,
                        const MotionDataOptions& loading, const RunContext& context,
                        bool& started) {
  Attempt out;
  started = false;
  TURNSCAN_ASSIGN(out.data, load_motion(sequence, loading, context));
  context.begin_phase("find the motion", 4);
  TURNSCAN_ASSIGN(InitialMotion start,
                  initialise_motion(out.data, sequence.header(), options, context));
  context.advance();
  started = true;
  TURNSCAN_ASSIGN(out.refined, refine_motion(out.data, std::move(start), context));
  return out;
}

/// Attempts the calibration with the platter, or without it if nothing turns above the supposed
/// platter.
Result<Attempt> first_attempt(const FrameSequence& sequence, const FromMotionOptions& options,
                              MotionDataOptions& loading, const RunContext& context) {
  bool started = false;
  auto found = attempt(sequence, options, loading, context, started);
  if (found || started || found.error().code == ErrorCode::kCancelled) return found;
  loading.use_platter = false;
  auto without = attempt(sequence, options, loading, context, started);
  return without || without.error().code == ErrorCode::kCancelled ? std::move(without)
                                                                  : std::move(found);
}

bool fits_better(const Attempt& a, const Attempt& b) {
  const auto& c = a.refined.solution.covariance;
  return std::sqrt(c(0, 0) + c(1, 1)) < kLargestAxisSigma &&
         mean_pair_cost(a.data, a.refined.solution.state) <
             mean_pair_cost(b.data, b.refined.solution.state);
}

}  // namespace

Result<SensorMotion> calibrate_sensor(const FrameSequence& sequence,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      std::size_t max_samples, const RunContext& context) {
  MotionDataOptions loading;
  loading.detect = detect;
  loading.level = true;
  // The rotating object verifies the platter; edges of stereo cameras are rough (0.73 on a D435's
  // table).
  loading.detect.min_agreement = std::min(detect.min_agreement, kMinAgreement);
  loading.detect.min_confidence = std::min(detect.min_confidence, kMinConfidence);
  loading.max_keys = std::size_t(options.key_frames);
  if (options.use_table) loading.hint = sequence.header().turntable;
  TURNSCAN_ASSIGN(Attempt found, first_attempt(sequence, options, loading, context));
  if (!found.refined.platter_fits) {
    loading.use_platter = false;
    bool started = false;
    auto again = attempt(sequence, options, loading, context, started);
    if (!again && again.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(again.error());
    const bool better = again && fits_better(*again, found);
    if (better) found = std::move(*again);
    found.data.notes.emplace_back(
        better ? "a round surface was seen, but the object turns about another axis, so it was not "
                 "taken for the platter"
               : "the object does not turn square to the platter, or wobbles");
  }
  TURNSCAN_ASSIGN(Calibration calibration,
                  to_calibration(found.data, found.refined, sequence, options));
  return with_model(std::move(calibration), found.data, found.refined.solution.state, max_samples);
}

}  // namespace turnscan::motion

namespace turnscan {

OptionTable describe(FromMotionOptions& o) {
  OptionTable table;
  table
      .number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-1000.0, 1000.0},
              "Speed of the platter, counter-clockwise from above is positive; used where the "
              "recording does not show it")
      .flag("motion-angles", o.use_angles, "Start from the frames' own angles, if they have any")
      .flag("motion-table", o.use_table,
            "Start from the recording's turntable where no platter is seen")
      .number("motion-keys", o.key_frames, {3, 2000}, "Frames that others are compared with")
      .number("motion-angle-sigma", o.angle_sigma_rad, Quantity::kAngle, {1e-6, 1.0},
              "Standard deviation of the frames' own angles");
  return table;
}

Result<Calibration> calibrate_from_motion(const FrameSequence& sequence,
                                          const FromMotionOptions& options,
                                          const DetectOptions& detect, const RunContext& context) {
  FromMotionOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  const auto& frames = sequence.frames();
  const bool angles =
      options.use_angles && std::all_of(frames.begin(), frames.end(),
                                        [](const FrameInfo& f) { return f.angle_rad.has_value(); });
  if (!angles && std::any_of(frames.begin(), frames.end(), [&](const FrameInfo& f) {
        return f.stretch != frames.front().stretch;
      }))
    return motion::calibrate_stretches(sequence, options, detect, context);
  if (sequence.header().sensors.size() > 1)
    return motion::calibrate_sensors(sequence, options, detect, context);
  TURNSCAN_ASSIGN(motion::SensorMotion found,
                  motion::calibrate_sensor(sequence, options, detect, 0, context));
  return std::move(found.calibration);
}

}  // namespace turnscan
