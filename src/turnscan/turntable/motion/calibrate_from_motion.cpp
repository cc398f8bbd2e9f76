#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/motion/publication.hpp>

namespace turnscan::motion {

Result<SensorMotion> calibrate_sensor(const FrameSequence& sequence,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      std::size_t max_samples, const RunContext& context) {
  MotionDataOptions loading;
  loading.detect = detect;
  loading.max_keys = std::size_t(options.key_frames);
  if (options.use_table) loading.hint = sequence.header().turntable;
  TURNSCAN_ASSIGN(const MotionData data, load_motion(sequence, loading, context));
  context.begin_phase("find the motion", 4);
  TURNSCAN_ASSIGN(InitialMotion start,
                  initialise_motion(data, sequence.header(), options, context));
  context.advance();
  TURNSCAN_ASSIGN(const RefinedMotion refined,
                  refine_motion(data, std::move(start), options, context));
  TURNSCAN_ASSIGN(Calibration found, publish_motion(data, refined, sequence, options));
  return with_model(std::move(found), data, refined.solution.state, max_samples);
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
  if (sequence.header().sensors.size() > 1)
    return motion::calibrate_sensors(sequence, options, detect, context);
  TURNSCAN_ASSIGN(motion::SensorMotion found,
                  motion::calibrate_sensor(sequence, options, detect, 0, context));
  return std::move(found.calibration);
}

}  // namespace turnscan
