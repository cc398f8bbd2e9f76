#pragma once
// Continues a calibration from the motion of the first frames to the frames that follow.

#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

namespace turnscan {

struct ContinuedMotion {
  /// The given calibration, with an angle for every frame of the sequence.
  Calibration calibration;
  double noise_m = 0.0;  ///< of one depth value
};

/// For scans that are processed while they are recorded: axis, centre and the angles in `first`
/// stay fixed; the frames after them get the angles with which they fit the last of those frames,
/// and those of one turn earlier (point-to-plane distances, as in calibrate_from_motion). Takes a
/// tenth of the time of calibrating all frames. Does not check that the turn closes, see
/// measure_closure().
/// Sensor 0 alone. Fails with kInvalidOption if `first` has no angles or as many as there are
/// frames, with kTooFewPoints if the later frames show too little of an object, with kLibrary, with
/// kCancelled, and with the errors of reading.
Result<ContinuedMotion> continue_motion(const FrameSequence& sequence, const Calibration& first,
                                        const DetectOptions& detect, const RunContext& context);

}  // namespace turnscan
