#pragma once
// A ball of known diameter as a gauge of a sensor's depth.

#include <turnscan/core/option_table.hpp>
#include <turnscan/turntable/depth/depth_bias.hpp>

namespace turnscan {

struct BallOptions {
  std::optional<double> diameter_m;
};
/// Field gauge-ball.
OptionTable describe(BallOptions& options);

/// Depth error measured on a ball, and where the ball was.
struct BallGauge {
  DepthGauge gauge;
  Vec3d center_m = Vec3d::Zero();  ///< sensor frame, with the corrected depth
  double rms_m = 0.0;              ///< root mean square of the pixels' distances from the sphere
  std::size_t pixels = 0;          ///< number of pixels used
};

/// The depth offset at which the visible surface fits a ball of this diameter (2 cm to 1 m): depth
/// that is too small by b makes everything narrower, but not flatter. The ball may be anywhere in
/// the scan, with most of its visible side unoccluded, and must stand still. Least squares over its
/// centre and the offset, over pixels with an incidence angle below 65 degrees; the standard
/// deviation accounts for errors that neighbouring pixels share. recorded_m: the offset that the
/// scan already contains. Fails with kInvalidOption for a diameter out of range, with kMissingData
/// if no such ball or two of them are seen, with kCancelled.
Result<BallGauge> gauge_depth_with_ball(const AveragedScan& scan, double diameter_m,
                                        double recorded_m, const RunContext& context);

}  // namespace turnscan
