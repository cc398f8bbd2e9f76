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
  double rms_m = 0.0;  ///< of the residuals
  std::size_t residuals = 0;
  double variance_m2 = 0.0;  ///< of one, enlarged by what correlated errors add
};

/// The axis about which the frames fit each other best when they stand at these angles (one for
/// each of data.frames), near start; least squares over pairs of frames (solve_pairwise). Fails
/// with kTooFewPoints when the frames have too little in common, kLibrary and kCancelled.
Result<AxisFit> fit_axis(const MotionData& data, const TurntableInfo& start,
                         const std::vector<double>& angle_rad, const RunContext& context);

/// Chi-square of the start's axis beside the one that was fitted: by how much more the squares of
/// the residuals sum up to with it, in variances of one. Infinite where less than half as much
/// meets with it. Where an object's shape leaves the axis open, as a ball's does, errors move the
/// fit far, but gain nothing. The arguments are those of the fit. Fails with kCancelled.
Result<double> gain_over_start(const AxisFit& fit, const MotionData& data,
                               const TurntableInfo& start, const std::vector<double>& angle_rad,
                               const RunContext& context);

}  // namespace turnscan::motion
