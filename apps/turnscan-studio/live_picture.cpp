#include "live_picture.hpp"

#include <algorithm>
#include <cmath>

namespace turnscan::studio {

namespace {

constexpr int kReach = 3;               // pixels; nearer ones show the noise more than the shape
constexpr float kJump = 0.04f;          // of the depth: what lies behind is another surface
constexpr Rgb kPlain{104, 150, 176};    // seen face on
constexpr Rgb kUnknown{122, 142, 154};  // where the slope is not known

Rgb shade(const Vec3f& p, const Vec3f& across, const Vec3f& down) {
  const Vec3f normal = across.cross(down);
  const float length = normal.norm() * p.norm();
  if (!(length > 0.0f)) return kUnknown;
  // A little from the left and above, so that walls to both sides differ.
  const Vec3f lamp = (-p.normalized() + Vec3f(-0.35f, -0.35f, 0.0f)).normalized();
  Vec3f facing = normal / normal.norm();
  if (facing.dot(p) > 0.0f) facing = -facing;
  const float light = 0.42f + 0.68f * std::max(0.0f, facing.dot(lamp));
  const auto scaled = [light](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(light * float(value), 0.0f, 255.0f));
  };
  return {scaled(kPlain.r), scaled(kPlain.g), scaled(kPlain.b)};
}

/// Points by their place in the grid.
class Neighbours {
 public:
  explicit Neighbours(const FramePoints& points) : points_(points) {
    if (points.width <= 0 || points.cell.size() != points.cloud.size()) return;
    at_.assign(std::size_t(points.width) * std::size_t(points.height), -1);
    for (std::size_t i = 0; i < points.cell.size(); ++i)
      at_[std::size_t(points.cell[i])] = static_cast<std::int32_t>(i);
  }

  Rgb color(std::size_t i) const {
    if (at_.empty()) return kUnknown;
    const int row = points_.cell[i] / points_.width, column = points_.cell[i] % points_.width;
    const auto across = slope(i, row, column, 0, kReach), down = slope(i, row, column, kReach, 0);
    return across && down ? shade(points_.cloud.points[i], *across, *down) : kUnknown;
  }

 private:
  std::optional<Vec3f> slope(std::size_t i, int row, int column, int rows, int columns) const {
    const Vec3f& here = points_.cloud.points[i];
    const Vec3f* before = near(here, row - rows, column - columns);
    const Vec3f* after = near(here, row + rows, column + columns);
    if (!before && !after) return std::nullopt;
    return Vec3f((after ? *after : here) - (before ? *before : here));
  }

  const Vec3f* near(const Vec3f& here, int row, int column) const {
    if (row < 0 || column < 0 || row >= points_.height || column >= points_.width) return nullptr;
    const std::int32_t i = at_[std::size_t(row) * std::size_t(points_.width) + std::size_t(column)];
    if (i < 0) return nullptr;
    const Vec3f& there = points_.cloud.points[std::size_t(i)];
    return std::abs(there.z() - here.z()) < kJump * std::abs(here.z()) ? &there : nullptr;
  }

  const FramePoints& points_;
  std::vector<std::int32_t> at_;
};

}  // namespace

PointCloud live_picture(const FramePoints& points, const std::optional<SensorCrop>& crop,
                        std::size_t most) {
  PointCloud shown;
  const PointCloud& all = points.cloud;
  const Neighbours neighbours(points);
  const std::size_t step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
  for (std::size_t i = 0; i < all.size(); i += step) {
    if (crop && !crop->keeps(all.points[i])) continue;
    shown.points.push_back(all.points[i]);
    shown.colors.push_back(all.colors.empty() ? neighbours.color(i) : all.colors[i]);
  }
  return shown;
}

}  // namespace turnscan::studio
