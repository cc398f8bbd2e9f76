#include <algorithm>
#include <cmath>
#include <turnscan/simulator/rendering/picture_camera.hpp>

namespace turnscan::rendering {

namespace {

constexpr double kMargin = 1.08;

struct Framing {
  double distance = 0.0;    ///< of the eye from the point aimed at, so that all is in the picture
  double x = 0.0, y = 0.0;  ///< middle of what is seen, as slopes
};

Framing frame_of(std::span<const Vec3f> points, const PictureCamera& camera, const Vec3d& aim) {
  Framing f;
  for (const Vec3f& point : points) {
    const Vec3d p = point.cast<double>() - aim;
    const double near = -p.dot(camera.forward);
    const double x = std::abs(p.dot(camera.right)) / camera.tan_x;
    const double y = std::abs(p.dot(camera.up)) / camera.tan_y;
    f.distance = std::max(f.distance, near + kMargin * std::max(x, y));
  }
  double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
  for (const Vec3f& point : points) {
    const Vec3d p = point.cast<double>() - aim;
    const double z = std::max(f.distance + p.dot(camera.forward), 1e-3 * f.distance);
    const double x = p.dot(camera.right) / z, y = p.dot(camera.up) / z;
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  f.x = 0.5 * (low_x + high_x);
  f.y = 0.5 * (low_y + high_y);
  return f;
}

}  // namespace

PictureCamera camera_around(std::span<const Vec3f> points, double azimuth_rad, double elevation_rad,
                            double field_of_view_rad, double aspect, double zoom) {
  PictureCamera camera;
  const double ca = std::cos(azimuth_rad), sa = std::sin(azimuth_rad);
  const double ce = std::cos(elevation_rad), se = std::sin(elevation_rad);
  camera.forward = -Vec3d(sa * ce, se, ca * ce);
  camera.right = Vec3d(ca, 0.0, -sa);
  camera.up = camera.right.cross(camera.forward);
  camera.tan_y = std::tan(0.5 * field_of_view_rad);
  camera.tan_x = camera.tan_y * aspect;
  Box box;
  for (const Vec3f& p : points) box.add(p.cast<double>());
  if (box.empty()) return camera;
  Vec3d aim = box.center();
  Framing f = frame_of(points, camera, aim);
  for (int i = 0; i < 4; ++i) {
    aim += f.distance * (f.x * camera.right + f.y * camera.up);
    f = frame_of(points, camera, aim);
  }
  camera.eye = aim - std::max(f.distance / zoom, 1e-9) * camera.forward;
  return camera;
}

}  // namespace turnscan::rendering
