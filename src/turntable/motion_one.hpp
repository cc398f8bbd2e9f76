#pragma once
// Calibration from the motion that one sensor sees, with what several of them are compared by.
// Internal to turntable: not installed.

#include <turnscan/turntable/motion.hpp>
#include <turnscan/turntable/motion_data.hpp>

namespace turnscan::detail {

struct MotionResult {
  Calibration calibration;
  std::vector<MotionSample> model;  ///< what was seen, table frame of this sensor, at angle 0
  double noise_m = 0.0, spacing_m = 0.0;
  bool platter = false;  ///< the height is the platter's
};

/// As calibrate_from_motion(), of the frames of sensor 0 alone. most: samples of the model, spread
/// over all frames; 0: none.
Result<MotionResult> calibrate_one(const FrameSequence& sequence, const FromMotionOptions& options,
                                   const DetectOptions& detect, std::size_t most,
                                   const RunContext& context);

/// Of a sequence with several sensors; see calibrate_from_motion().
Result<Calibration> calibrate_several(const FrameSequence& sequence,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      const RunContext& context);

}  // namespace turnscan::detail
