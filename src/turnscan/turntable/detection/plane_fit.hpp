#pragma once
// Planes in a depth image, and the round one among them.

#include <cstdint>
#include <optional>
#include <turnscan/core/camera.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <vector>

namespace turnscan::detection {

/// Points with normal . p = offset; normal has unit length and points to the sensor (the origin).
struct Plane {
  Vec3d normal = -Vec3d::UnitZ();
  double offset = 0.0;  ///< metres, negative: the sensor is on the side of the normal

  double height(const Vec3d& p) const { return normal.dot(p) - offset; }
  /// Depth along z at which the ray (x, y, 1) meets it; not positive where it does not.
  double depth_along(const Vec3d& ray) const { return offset / normal.dot(ray); }
};

/// What the searches know of one pixel.
struct ScanPixels {
  int width = 0, height = 0;
  std::vector<Vec3f> point;         ///< sensor frame; z = 0 where not valid
  std::vector<std::uint8_t> still;  ///< valid, and not noisier than a still surface is
  std::vector<float> deviation_m;   ///< of one frame; NaN where not known
  double still_limit_m = 0.0;       ///< of a still surface's deviation
  double nearest_m = 0.0;           ///< depth along z of the nearest still pixel
  double noise_m = 0.0;             ///< typical, of the average
  double frame_noise_m = 0.0;       ///< typical, of one frame
};
ScanPixels pixels_of(const AveragedScan& scan);

struct FoundPlane {
  Plane plane;
  double tolerance_m = 0.0;
  std::vector<std::int32_t> pixels;  ///< still pixels within the tolerance
};

/// The planes with the most pixels, largest first, each of pixels that no earlier one has: three
/// points of one neighbourhood make a hypothesis (Fischler and Bolles 1981), refined by least
/// squares in inverse depth, which is where the noise is. Up to `most` planes of at least
/// `least_pixels`. Ends early, with what it has, once the context is cancelled.
std::vector<FoundPlane> find_planes(const ScanPixels& scan, const RayTable& rays, int most,
                                    std::size_t least_pixels, const RunContext& context);

struct PlaneEstimate {
  Plane plane;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of normal / offset (1 / m^2)
  double rms_m = 0.0;                                    ///< perpendicular distances
};
/// Least squares over pixels, Huber-weighted; needs 3 that span a plane, else nullopt.
std::optional<PlaneEstimate> fit_plane(const ScanPixels& scan, const RayTable& rays,
                                       const std::vector<std::int32_t>& pixels);

}  // namespace turnscan::detection
