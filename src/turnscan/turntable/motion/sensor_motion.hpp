#pragma once
// Calibration from the motion that one sensor observes, with the model for comparing sensors.

#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct SensorMotion {
  Calibration calibration;
  /// Samples of the observed surface, in the table frame of this sensor, at angle 0.
  std::vector<SurfaceSample> model;
  double noise_m = 0.0, spacing_m = 0.0;
  bool platter = false;  ///< the height is that of the platter
};

/// As calibrate_from_motion(), for the frames of sensor 0 alone. max_samples: size of the model,
/// spread over all frames; 0: none.
Result<SensorMotion> calibrate_sensor(const FrameSequence& sequence,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      std::size_t max_samples, const RunContext& context);

/// For a sequence with several sensors; see calibrate_from_motion().
Result<Calibration> calibrate_sensors(const FrameSequence& sequence,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      const RunContext& context);

/// For a sequence with several stretches (FrameInfo::stretch); see calibrate_from_motion().
Result<Calibration> calibrate_stretches(const FrameSequence& sequence,
                                        const FromMotionOptions& options,
                                        const DetectOptions& detect, const RunContext& context);

}  // namespace turnscan::motion
