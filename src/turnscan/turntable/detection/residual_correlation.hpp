#pragma once
// How far the noise of neighbouring pixels is one and the same.

#include <turnscan/turntable/detection/plane_fit.hpp>

namespace turnscan::detection {

struct NoiseCorrelation {
  /// Pixels that tell as much as one independent one: the sum of the correlations with all
  /// neighbours, itself included (Bartlett 1946).
  double pixels_per_sample = 1.0;
  int blur_px = 0;       ///< the sensor's filter reaches this far, 0 to 2
  double sigma_m = 0.0;  ///< of a pixel's depth along z
};

/// From the depth along z by which pixels miss their plane.
NoiseCorrelation correlation_of(const ScanPixels& scan, const RayTable& rays, const Plane& plane,
                                const std::vector<std::int32_t>& pixels);

}  // namespace turnscan::detection
