#pragma once
// Refines an approximate platter to the best estimate with realistic standard deviations.

#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/detection/disc_support.hpp>
#include <turnscan/turntable/detection/rim_estimate.hpp>

namespace turnscan::detection {

struct PlatterCandidate {
  DetectedPlatter platter;
  DiscSupport support;
  double tolerance_m = 0.0;  ///< of its plane
};

/// References that must outlive every object made from them.
struct ScanImage {
  const ScanPixels& pixels;
  const CameraIntrinsics& camera;
  const RayTable& rays;
};

/// origin: a point near the plane.
PlaneView view_of(const ScanImage& image, const Plane& plane, double tolerance_m,
                  const Vec3d& origin);

/// Estimates the plane from the pixels that no edge can have affected, and the rim by maximum
/// likelihood. nullopt if there are too few of them, or once the context is cancelled. radius_m:
/// the platter's, if known.
std::optional<PlatterCandidate> refine_platter(const ScanImage& image,
                                               const PlatterCandidate& rough,
                                               std::optional<double> radius_m,
                                               const RunContext& context);

}  // namespace turnscan::detection
