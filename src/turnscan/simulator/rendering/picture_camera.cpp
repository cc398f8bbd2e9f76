#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/rendering/picture_camera.hpp>

namespace turnscan::rendering {

namespace {

constexpr double kMargin = 1.08;

struct Framing {
  double distance = 0.0;    ///< of the eye from the point aimed at, for which everything is in the
                            ///< picture
  double x = 0.0, y = 0.0;  ///< centre of the visible part, as slopes
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

std::vector<Vec3f> swept_about(std::span<const Vec3f> points, const Vec3d& axis) {
  constexpr std::size_t kRings = 256, kPerRing = 64;
  float low = 1e30f, high = -1e30f;
  for (const Vec3f& p : points) low = std::min(low, p.y()), high = std::max(high, p.y());
  struct Ring {
    float radius = -1.0f, low = 1e30f, high = -1e30f;
  };
  std::vector<Ring> rings(kRings);
  const float step = std::max(high - low, 1e-30f) / float(kRings);
  for (const Vec3f& p : points) {
    Ring& ring = rings[std::min(kRings - 1, std::size_t((p.y() - low) / step))];
    ring.radius =
        std::max(ring.radius, std::hypot(p.x() - float(axis.x()), p.z() - float(axis.z())));
    ring.low = std::min(ring.low, p.y()), ring.high = std::max(ring.high, p.y());
  }
  std::vector<Vec3f> out;
  for (const Ring& ring : rings) {
    if (ring.radius < 0.0f) continue;
    for (std::size_t k = 0; k < kPerRing; ++k) {
      const double angle = kTurn * double(k) / double(kPerRing);
      const Vec3d side = axis + double(ring.radius) * Vec3d(std::sin(angle), 0.0, std::cos(angle));
      out.emplace_back(float(side.x()), ring.low, float(side.z()));
      out.emplace_back(float(side.x()), ring.high, float(side.z()));
    }
  }
  return out;
}

PictureCamera turned_about(const PictureCamera& camera, const Vec3d& axis, double angle_rad) {
  const Eigen::Matrix3d turn = rotation_about_y(angle_rad).linear();
  PictureCamera out = camera;
  out.eye = axis + turn * (camera.eye - axis);
  out.right = turn * camera.right;
  out.up = turn * camera.up;
  out.forward = turn * camera.forward;
  return out;
}

}  // namespace turnscan::rendering
