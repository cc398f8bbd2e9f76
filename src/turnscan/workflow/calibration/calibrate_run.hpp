#pragma once
// Calibration as run by a command, a window or a script: first the sensors' cameras and depth, if
// something is known about them, then the turntable.

#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/depth/gauge_ball.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <vector>

namespace turnscan {

enum class CalibrationWay {
  kAuto,     ///< from motion; if no rotation can be observed, from the platter
  kPoints,   ///< from points picked on the platter's rim
  kPlatter,  ///< from the platter in the averaged frames; the speed only if stated
  kMotion    ///< from the motion of the object on the platter
};

/// The way that is asked for; kAuto if none is. Fails with kInvalidOption if several are.
Result<CalibrationWay> calibration_way(bool points, bool detect, bool from_motion);

struct CalibrateRequest {
  CalibrationWay way = CalibrationWay::kAuto;
  std::string points;  ///< CSV file of the picked points, see docs/reference/calibration.md
  /// Folders with iai_kinect2 calibrations (see read_iai_kinect2) for sensors 0, 1, ...
  std::vector<std::string> iai_folders;
  /// Estimate the offset of each sensor's depth from ball.diameter_m, or else from detect.radius_m.
  bool depth_bias = false;
  std::string depth_also;  ///< recording of the same object at another distance: adds the scale
  AverageOptions average;
  DetectOptions detect;
  BallOptions ball;
  FromMotionOptions motion;
  std::string made_at;  ///< when the frames were taken; empty: as the recording says

  /// Fails with kInvalidOption if options contradict each other, or one would do nothing.
  Result<> check() const;
};

/// Returns the calibration as it is read back from its file (see write_calibration()). Fails with
/// kInvalidOption (as CalibrateRequest::check(), more folders than sensors, a depth_also of other
/// sensors), kFormat (the file of points), kMissingData (no method finds the turntable),
/// kCancelled, and as the frames do.
Result<Calibration> run_calibration(const FrameSequence& sequence, const CalibrateRequest& request,
                                    const RunContext& context);

}  // namespace turnscan
