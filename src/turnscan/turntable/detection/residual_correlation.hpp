#pragma once
// Correlation of the noise of neighbouring pixels.

#include <turnscan/turntable/detection/plane_fit.hpp>

namespace turnscan::detection {

struct NoiseCorrelation {
  /// Number of pixels with the information of one independent pixel: the sum of the correlations
  /// with all neighbours, itself included (Bartlett 1946).
  double pixels_per_sample = 1.0;
  int blur_px = 0;       ///< reach of the sensor's filter, 0 to 2
  double sigma_m = 0.0;  ///< of a pixel's depth along z
};

/// Estimates the correlation from the residuals of pixels about their plane, in depth along z.
NoiseCorrelation correlation_of(const ScanPixels& scan, const RayTable& rays, const Plane& plane,
                                const std::vector<std::int32_t>& pixels);

}  // namespace turnscan::detection
