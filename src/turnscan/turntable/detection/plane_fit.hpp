#pragma once
// Planes in a depth image.

#include <cstdint>
#include <optional>
#include <turnscan/core/camera.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <vector>

namespace turnscan::detection {

/// Points with normal . p = offset; normal has unit length and points towards the sensor (the
/// origin).
struct Plane {
  Vec3d normal = -Vec3d::UnitZ();
  double offset = 0.0;  ///< metres, negative: the sensor is on the side of the normal

  double height(const Vec3d& p) const { return normal.dot(p) - offset; }
  /// Depth along z at which the ray (x, y, 1) intersects the plane; not positive if it does not.
  double depth_along(const Vec3d& ray) const { return offset / normal.dot(ray); }
};

/// Per-pixel input of the searches.
struct ScanPixels {
  int width = 0, height = 0;
  std::vector<Vec3f> point;         ///< sensor frame; z = 0 where not valid
  std::vector<std::uint8_t> still;  ///< valid, and not noisier than a static surface
  std::vector<float> deviation_m;   ///< of a single frame; NaN if not known
  double still_limit_m = 0.0;       ///< upper limit of a static surface's deviation
  double nearest_m = 0.0;           ///< depth along z of the nearest still pixel
  double noise_m = 0.0;             ///< typical, of the average
  double frame_noise_m = 0.0;       ///< typical, of a single frame
};
ScanPixels pixels_of(const AveragedScan& scan);

struct FoundPlane {
  Plane plane;
  double tolerance_m = 0.0;
  std::vector<std::int32_t> pixels;  ///< still pixels within the tolerance
};

/// The planes with the most pixels, largest first, each of pixels that no earlier one has: three
/// points of a neighbourhood make a hypothesis (Fischler and Bolles 1981), refined by least squares
/// in inverse depth, where the noise is. Up to `most` planes of at least `least_pixels`. Ends
/// early, with the planes found so far, once the context is cancelled.
std::vector<FoundPlane> find_planes(const ScanPixels& scan, const RayTable& rays, int most,
                                    std::size_t least_pixels, const RunContext& context);

struct PlaneEstimate {
  Plane plane;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of normal / offset (1 / m^2)
  double rms_m = 0.0;                                    ///< perpendicular distances
};
/// Huber-weighted least squares over pixels; nullopt if there are not 3 that span a plane.
std::optional<PlaneEstimate> fit_plane(const ScanPixels& scan, const RayTable& rays,
                                       const std::vector<std::int32_t>& pixels);

}  // namespace turnscan::detection
