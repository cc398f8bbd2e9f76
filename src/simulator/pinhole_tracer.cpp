#include <algorithm>
#include <cmath>
#include <turnscan/simulator/pinhole_tracer.hpp>

namespace turnscan {

namespace {

constexpr int kTile = 4;             // a packet of rays is a square of pixels
constexpr double kNearest_m = 1e-3;  // a corner nearer than this may be anywhere in the image

}  // namespace

PinholeTracer::PinholeTracer(const CameraIntrinsics& intrinsics)
    : camera_(intrinsics), rays_(intrinsics) {}

/// Outside of it no pixel sees anything of the box; it has a border of a pixel.
PixelRect PinholeTracer::rect_of(const Box& box, const Pose& T_sensor_scene) const {
  const PixelRect all{0, 0, camera_.width, camera_.height};
  if (box.empty()) return {};
  // Distortion may bulge between the corners.
  if (camera_.distorted()) return all;
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p((corner & 1 ? box.max : box.min).x(), (corner & 2 ? box.max : box.min).y(),
                  (corner & 4 ? box.max : box.min).z());
    const Vec3d q = T_sensor_scene * p;
    if (q.z() < kNearest_m) return all;
    low = low.cwiseMin(camera_.project(q));
    high = high.cwiseMax(camera_.project(q));
  }
  const auto pixel = [](double v, int size) {
    return static_cast<int>(std::clamp(v, 0.0, double(size)));
  };
  return {pixel(std::floor(low.x()) - 1, camera_.width),
          pixel(std::floor(low.y()) - 1, camera_.height),
          pixel(std::ceil(high.x()) + 2, camera_.width),
          pixel(std::ceil(high.y()) + 2, camera_.height)};
}

Ray PinholeTracer::ray(int column, int row, const Pose& T_scene_sensor) const {
  const std::size_t pixel = std::size_t(row) * std::size_t(camera_.width) + std::size_t(column);
  Ray ray;
  ray.origin = T_scene_sensor.translation().cast<float>();
  ray.direction =
      (T_scene_sensor.linear() * Vec3d(rays_.x()[pixel], rays_.y()[pixel], 1.0)).cast<float>();
  return ray;
}

/// Strips of kTile rows, each strip tile by tile, so that the rays of a packet are neighbours.
Sight PinholeTracer::trace(const Scene& scene, const Pose& T_scene_sensor) const {
  Sight sight{rect_of(scene.box(), T_scene_sensor.inverse()), {}};
  const PixelRect& r = sight.rect;
  if (r.width() <= 0 || r.height() <= 0) return {};
  sight.hits.resize(std::size_t(r.width()) * std::size_t(r.height()));
  std::vector<Ray> strip;
  std::vector<RayHit> hits;
  std::vector<std::size_t> place;
  for (int top = r.top; top < r.bottom; top += kTile) {
    strip.clear();
    place.clear();
    for (int left = r.left; left < r.right; left += kTile) {
      for (int y = top; y < std::min(top + kTile, r.bottom); ++y) {
        for (int x = left; x < std::min(left + kTile, r.right); ++x) {
          strip.push_back(ray(x, y, T_scene_sensor));
          place.push_back(std::size_t(y - r.top) * std::size_t(r.width()) +
                          std::size_t(x - r.left));
        }
      }
    }
    hits.resize(strip.size());
    scene.intersect(strip, hits, RayOrder::kCoherent);
    for (std::size_t k = 0; k < hits.size(); ++k) sight.hits[place[k]] = hits[k];
  }
  return sight;
}

}  // namespace turnscan
