#pragma once
// A ball of known size as a gauge of a sensor's depth.

#include <turnscan/core/option_table.hpp>
#include <turnscan/turntable/depth/depth_bias.hpp>

namespace turnscan {

struct BallOptions {
  std::optional<double> diameter_m;
};
/// Field gauge-ball.
OptionTable describe(BallOptions& options);

/// What a ball says about depth, and where it was seen.
struct BallGauge {
  DepthGauge gauge;
  Vec3d center_m = Vec3d::Zero();  ///< sensor frame, with the corrected depth
  double rms_m = 0.0;              ///< of the pixels' distances from the ball
  std::size_t pixels = 0;          ///< that were used
};

/// The offset of depth at which the surface of a ball fits a ball of this diameter (2 cm to 1 m):
/// depth that is b too small makes everything narrower, but not flatter. The ball may lie anywhere
/// in the scan, with most of its visible side free, and must stand still. Least squares over its
/// centre and the offset, over pixels that are seen at less than 65 degrees; the standard deviation
/// counts errors that neighbouring pixels share. recorded_m: the offset that the scan has already.
/// Fails with kInvalidOption for a diameter out of range, kMissingData when no such ball is seen or
/// two are, kCancelled.
Result<BallGauge> gauge_depth_with_ball(const AveragedScan& scan, double diameter_m,
                                        double recorded_m, const RunContext& context);

}  // namespace turnscan
