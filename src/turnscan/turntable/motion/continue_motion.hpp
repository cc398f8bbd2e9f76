#pragma once
// A calibration from the motion of the first frames, continued to those that came after them.

#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

namespace turnscan {

struct ContinuedMotion {
  /// The one given, with an angle for every frame of the sequence.
  Calibration calibration;
  double noise_m = 0.0;  ///< of one depth value
};

/// For a scan that is worked on before it is over: axis, centre and the angles that `first` has
/// stay as they are; the frames after them get angles by which they fit the last of those frames,
/// and those of one turn earlier (point-to-plane distances, as in calibrate_from_motion). Takes a
/// tenth of the time of calibrating all frames. Whether the turn closes is not judged here, see
/// measure_closure().
/// Sensor 0 alone. Fails with kInvalidOption when `first` has no angles or as many as there are
/// frames, kTooFewPoints when the later frames show too little of an object, kLibrary, kCancelled,
/// and what reading fails with.
Result<ContinuedMotion> continue_motion(const FrameSequence& sequence, const Calibration& first,
                                        const DetectOptions& detect, const RunContext& context);

}  // namespace turnscan
