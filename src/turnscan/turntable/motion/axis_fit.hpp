#pragma once
// The axis alone, where the angles are known.

#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct AxisFit {
  Vec3d axis = Vec3d::UnitY();     ///< unit, sensor frame
  Vec3d center_m = Vec3d::Zero();  ///< a point of it beside the object
  double axis_sigma_rad = 0.0;
  double center_sigma_m = 0.0;
  /// By how much less the squares of the residuals sum up to than with the axis of the start, in
  /// variances of one: chi-square of the start's axis beside this one. Infinite where less than
  /// half as much meets with it. Where an object's shape leaves the axis open, as a ball does,
  /// errors move it far, but gain nothing.
  double gain = 0.0;
};

/// The axis about which the frames fit each other best when they stand at these angles (one for
/// each of data.frames), near start; least squares over pairs of frames (solve_pairwise). Fails
/// with kTooFewPoints when the frames have too little in common, kLibrary and kCancelled.
Result<AxisFit> fit_axis(const MotionData& data, const TurntableInfo& start,
                         const std::vector<double>& angle_rad, const RunContext& context);

}  // namespace turnscan::motion
