#pragma once
// A constant offset of a sensor's depth, from a platter of known radius; from recordings at two
// distances or more also its scale.

#include <span>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// How far depth is off at one distance.
struct DepthGauge {
  double depth_m = 0.0;   ///< depth of the platter's centre, as recorded without any offset
  double offset_m = 0.0;  ///< the correction to be added to it
  double sigma_m = 0.0;   ///< standard deviation of the offset
};

/// Depth that is b too small makes everything look smaller by b / depth: 2 % at 20 mm. The offset
/// is the one with which the detected rim has the radius that it has (secant method over
/// detect_platter); it replaces the recording's own, `recorded_m`. A platter at one distance cannot
/// tell an offset from a scale. options.radius_m is not used. Fails as detect_platter does, with
/// kInvalidOption for a radius out of range, and with kMissingData when the radius that is seen is
/// over a fifth off.
Result<DepthGauge> gauge_depth(const AveragedScan& scan, double radius_m, double recorded_m,
                               const DetectOptions& options, const RunContext& context);

/// Least-squares line through gauges at several distances, weighted by their standard deviations:
/// depth is scale times the recorded depth, plus bias_m. Fails with kTooFewPoints for fewer than
/// two gauges, and if their distances are less than 5 cm apart.
Result<DepthCorrection> fit_depth(std::span<const DepthGauge> gauges);

/// The scan with an offset added to its depth.
AveragedScan shifted(AveragedScan scan, double offset_m);

}  // namespace turnscan
