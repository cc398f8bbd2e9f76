#pragma once
// A constant offset of a sensor's depth, from a platter whose radius is known.

#include <turnscan/turntable/detect.hpp>

namespace turnscan {

/// Depth that is b too small makes everything look smaller by b / depth: 2 % at 20 mm. The offset
/// is the one with which the detected rim has the radius that it has (secant method over
/// detect_platter). bias_m replaces the recording's own offset, `recorded_m`. The scale stays 1: a
/// platter at one distance cannot tell it from an offset. options.radius_m is not used.
/// Fails as detect_platter does, with kInvalidOption for a radius out of range, and with
/// kMissingData when the radius that is seen is over a fifth off.
Result<DepthCorrection> estimate_depth_bias(const AveragedScan& scan, double radius_m,
                                            double recorded_m, const DetectOptions& options,
                                            const RunContext& context);

/// The same scan with an offset added to its depth.
AveragedScan shifted(AveragedScan scan, double offset_m);

}  // namespace turnscan
