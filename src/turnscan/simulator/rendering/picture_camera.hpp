#pragma once
// The camera of a picture.

#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::rendering {

/// Perspective; forward, right and up are unit vectors, tan_x and tan_y are half the picture's size
/// at distance 1.
struct PictureCamera {
  Vec3d eye = Vec3d::Zero();
  Vec3d right = Vec3d::UnitX(), up = Vec3d::UnitY(), forward = -Vec3d::UnitZ();
  double tan_x = 1.0, tan_y = 1.0;

  /// Direction through a point of the picture; x and y in [-1, 1], y upwards.
  Vec3d direction(double x, double y) const {
    return (forward + x * tan_x * right + y * tan_y * up).normalized();
  }
};

/// Looks at the points from azimuth (from +Z towards +X) and elevation so that all of them are in
/// the picture, centred, with a margin. zoom > 1 moves closer.
PictureCamera camera_around(std::span<const Vec3f> points, double azimuth_rad, double elevation_rad,
                            double field_of_view_rad, double aspect, double zoom);

/// Points of the body of revolution that the points sweep about a vertical axis: rings, from the
/// lowest to the highest.
std::vector<Vec3f> swept_about(std::span<const Vec3f> points, const Vec3d& axis);

/// The camera rotated about that axis by an angle, counter-clockwise seen from above.
PictureCamera turned_about(const PictureCamera& camera, const Vec3d& axis, double angle_rad);

}  // namespace turnscan::rendering
