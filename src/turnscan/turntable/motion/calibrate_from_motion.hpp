#pragma once
// Calibrates the turntable from the motion of what stands on it.

#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

struct FromMotionOptions {
  /// Signed, counter-clockwise seen from above is positive. The speed is estimated from the
  /// recording; this value is used if the object's shape does not determine its rotation.
  std::optional<double> speed_rad_s;
  bool use_angles = true;  ///< start from the frames' own angles, if all have one
  bool use_table = true;   ///< start from the recording's turntable if no platter is seen
  int key_frames = 460;    ///< number of frames whose surfaces are kept for comparison
  double angle_sigma_rad = 0.0174532925;  ///< of the frames' own angles
};
/// Fields speed, motion-angles, motion-table, motion-keys, motion-angle-sigma.
OptionTable describe(FromMotionOptions& options);

/// One least-squares problem over all frames of a sensor: they share the axis, each has one angle,
/// and the slow variation of the motor's speed is the angles' prior. The residuals are distances of
/// a frame's points from another frame's surface; the platter, if it is seen, initialises the axis
/// and gives its height. Speed, its sign and the moment the table started come from the recording's
/// times. What the data do not determine is listed in `undetermined`, and takes its value from the
/// prior.
/// Several sensors, at any height and azimuth, are calibrated one by one. A sensor that does not
/// observe the rotation takes the angles of one that does. Their angles are related by the frames'
/// times (or recorded angles), their yaws and heights by what they see of the same object: the
/// poses of sensors 1, 2, ... in the table frame of sensor 0 are in `others`.
/// Of a recording that was resumed without angles (FrameInfo::stretch) the longest stretch is
/// calibrated. The others are placed by what they show of the same surface; where this does not
/// determine the turn in between, or with several sensors, they are `left_out`.
/// Fails with kTooFewPoints if nothing turns, with kMissingData if the shape does not determine the
/// speed and none is given, with kInvalidOption, with kLibrary if no start leads to frames that
/// fit, with kCancelled, and with the errors of reading.
Result<Calibration> calibrate_from_motion(const FrameSequence& sequence,
                                          const FromMotionOptions& options,
                                          const DetectOptions& detect, const RunContext& context);

}  // namespace turnscan
