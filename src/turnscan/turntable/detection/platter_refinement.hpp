#pragma once
// From a rough platter to its best estimate with deviations that can be believed.

#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/detection/disc_support.hpp>
#include <turnscan/turntable/detection/rim_estimate.hpp>

namespace turnscan::detection {

struct PlatterCandidate {
  DetectedPlatter platter;
  DiscSupport support;
  double tolerance_m = 0.0;  ///< of its plane
};

/// All must outlive what is made of them.
struct ScanImage {
  const ScanPixels& pixels;
  const CameraIntrinsics& camera;
  const RayTable& rays;
};

/// origin: a point near the plane.
PlaneView view_of(const ScanImage& image, const Plane& plane, double tolerance_m,
                  const Vec3d& origin);

/// Plane from the pixels that no edge can have changed, rim by maximum likelihood. nullopt where
/// there is too little of them, or once the context is cancelled. radius_m: the platter's, if
/// known.
std::optional<PlatterCandidate> refine_platter(const ScanImage& image,
                                               const PlatterCandidate& rough,
                                               std::optional<double> radius_m,
                                               const RunContext& context);

}  // namespace turnscan::detection
