#pragma once
// The turntable from the motion of what stands on it.

#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

struct FromMotionOptions {
  /// Signed, counter-clockwise seen from above is positive. It is found from the recording; this is
  /// what is used where the object's shape says nothing about its turn.
  std::optional<double> speed_rad_s;
  bool use_angles = true;  ///< start from the frames' own angles, where all have one
  bool use_table = true;   ///< start from the recording's turntable where no platter is seen
  int key_frames = 460;    ///< frames whose surfaces are kept for comparison
  double angle_sigma_rad = 0.0174532925;  ///< of the frames' own angles
};
/// Fields speed, motion-angles, motion-table, motion-keys, motion-angle-sigma.
OptionTable describe(FromMotionOptions& options);

/// One least-squares problem over all frames of a sensor: they share the axis, each has one angle,
/// and that the motor's speed changes slowly is the angles' prior. The residuals are distances of a
/// frame's points from another frame's surface; the platter, when it is seen, initialises the axis
/// and gives its height. Speed, its sign and the moment the table
/// started come from the recording's times. What the data do not determine is listed in
/// `undetermined`, and was left to the prior.
/// Several sensors, at any height and azimuth, are calibrated one by one. A sensor that does not
/// see the turn takes the angles of one that does. Their angles are related by the frames' times
/// (or recorded angles), headings and heights by what the sensors see of the same object: the
/// places of sensors 1, 2, ... in the table of sensor 0 are in `others`. Fails with kTooFewPoints
/// when nothing turns, kMissingData when the shape says nothing about the speed and none is given,
/// kInvalidOption, kLibrary when no start leads to frames that fit, kCancelled, and what reading
/// fails with.
Result<Calibration> calibrate_from_motion(const FrameSequence& sequence,
                                          const FromMotionOptions& options,
                                          const DetectOptions& detect, const RunContext& context);

}  // namespace turnscan
