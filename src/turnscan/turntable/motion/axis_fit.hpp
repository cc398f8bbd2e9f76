#pragma once
// Estimates the axis alone, with known angles.

#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct AxisFit {
  Vec3d axis = Vec3d::UnitY();     ///< unit, sensor frame
  Vec3d center_m = Vec3d::Zero();  ///< a point on it, at the object
  double axis_sigma_rad = 0.0;
  double center_sigma_m = 0.0;
  double rms_m = 0.0;  ///< of the residuals
  std::size_t residuals = 0;
  double variance_m2 = 0.0;  ///< of one residual, inflated for correlated errors
};

/// The axis near start about which the frames fit each other best at these angles (one for each of
/// data.frames); least squares over pairs of frames (solve_pairwise). Fails with kTooFewPoints if
/// the frames have too little in common, with kLibrary and kCancelled.
Result<AxisFit> fit_axis(const MotionData& data, const TurntableInfo& start,
                         const std::vector<double>& angle_rad, const RunContext& context);

/// Chi-square of the start's axis relative to the fitted one: the increase of the sum of squared
/// residuals, in units of their variance. Infinite if less than half as many samples find a
/// counterpart with it. If an object's shape leaves the axis undetermined, as a ball's does, errors
/// move the fit far but gain nothing. The arguments are those of the fit. Fails with kCancelled.
Result<double> gain_over_start(const AxisFit& fit, const MotionData& data,
                               const TurntableInfo& start, const std::vector<double>& angle_rad,
                               const RunContext& context);

}  // namespace turnscan::motion
