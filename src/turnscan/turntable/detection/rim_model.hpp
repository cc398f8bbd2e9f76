#pragma once
// The platter as a cylinder in a depth image: its outline and its depth along a ray.

#include <optional>
#include <turnscan/turntable/detection/plane_fit.hpp>
#include <turnscan/turntable/detection/rim_fit.hpp>

namespace turnscan::detection {

/// A disc with a wall that descends from its rim. Coordinates are in a PlaneFrame of its surface.
struct RimModel {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  double thickness_m = 0.0;
};

/// Derivatives by center x, center y, radius, thickness.
using RimGradient = Eigen::Vector4d;

/// Distance of a ray inside the outline of disc and wall together, in pixels along a row or a
/// column, whichever crosses the outline more squarely; negative outside.
struct OutlineDistance {
  double px = 0.0;
  RimGradient gradient = RimGradient::Zero();
  double bearing_rad = 0.0;  ///< of the nearest point of the rim, in the plane
};

/// Depth along z of disc or wall.
struct SurfaceDepth {
  double z_m = 0.0;
  RimGradient gradient = RimGradient::Zero();
  double per_pixel_m = 0.0;  ///< change from pixel to pixel
  double slant_m = 0.0;      ///< the same for the plane
  double facing = 1.0;       ///< cosine between ray and normal
  bool wall = false;
};

/// Pixels [left, right) x [top, bottom).
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Rays of a camera in a plane's coordinates.
class RimView {
 public:
  RimView(const CameraIntrinsics& camera, const Plane& plane, const PlaneFrame& frame);

  /// nullopt if the ray does not meet the plane in front of the sensor.
  std::optional<OutlineDistance> outline(const RimModel& model, double column, double row) const;
  /// The same for the disc alone.
  std::optional<double> disc_px(const RimModel& model, double column, double row) const;
  /// Bounding box of the outline, enlarged by `margin` pixels; the whole image if the sensor is too
  /// near.
  PixelBox box(const RimModel& model, int margin) const;
  /// Outside the outline, evaluated at the nearest approach to the wall. nullopt as outline().
  std::optional<SurfaceDepth> surface(const RimModel& model, double column, double row) const;

 private:
  /// A ray (x, y, 1): at depth z its position is z * along + start in the plane's coordinates.
  struct PlaneRay {
    Eigen::Vector2d along;
    double slope;    ///< of the height above the plane, per metre of z
    double z_plane;  ///< where it intersects the plane
  };
  std::optional<PlaneRay> ray(double column, double row) const;
  struct OutlineDepth {
    double z_m;
    bool at_foot;
  };
  OutlineDepth depth_of_outline(const RimModel& model, const PlaneRay& ray) const;
  /// Metres per pixel in the direction `out` at constant height, between the ray at depth z and the
  /// point `to_rim_m` farther out.
  double metres_per_px(const PlaneRay& ray, double z, const Eigen::Vector2d& out,
                       double to_rim_m) const;

  const CameraIntrinsics& camera_;
  Plane plane_;
  PlaneFrame frame_;
  Vec3d u_, v_;
  Eigen::Vector2d start_;
};

}  // namespace turnscan::detection
