#include "scanner/live_picture.hpp"

#include <algorithm>
#include <cmath>

namespace turnscan::studio {

namespace {

constexpr int kReach = 3;       // pixels; closer neighbours show the noise rather than the shape
constexpr float kJump = 0.04f;  // relative to depth: a larger step is another surface
constexpr Rgb kPlain{104, 150, 176};  // seen frontally

Rgb shade(const Vec3f& p, const Vec3f& across, const Vec3f& down, const Rgb& color) {
  const Vec3f normal = across.cross(down);
  const float length = normal.norm() * p.norm();
  if (!(length > 0.0f)) return color;
  // Slightly from the left and above, so that walls on both sides differ.
  const Vec3f lamp = (-p.normalized() + Vec3f(-0.35f, -0.35f, 0.0f)).normalized();
  Vec3f facing = normal / normal.norm();
  if (facing.dot(p) > 0.0f) facing = -facing;
  const float light = 0.42f + 0.68f * std::max(0.0f, facing.dot(lamp));
  const auto scaled = [light](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(light * float(value), 0.0f, 255.0f));
  };
  return {scaled(color.r), scaled(color.g), scaled(color.b)};
}

/// Neighbouring points in the grid.
class Neighbours {
 public:
  explicit Neighbours(const FramePoints& points) : points_(points) {
    if (points.width <= 0 || points.cell.size() != points.cloud.size()) return;
    at_.assign(std::size_t(points.width) * std::size_t(points.height), -1);
    for (std::size_t i = 0; i < points.cell.size(); ++i)
      at_[std::size_t(points.cell[i])] = static_cast<std::int32_t>(i);
  }

  Rgb shaded(std::size_t i, const Rgb& color) const {
    if (at_.empty()) return color;
    const int row = points_.cell[i] / points_.width, column = points_.cell[i] % points_.width;
    const auto across = slope(i, row, column, 0, kReach), down = slope(i, row, column, kReach, 0);
    return across && down ? shade(points_.cloud.points[i], *across, *down, color) : color;
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

LivePicture live_picture(const FramePoints& points, const std::optional<SensorCrop>& crop,
                         std::size_t most, const Tint& tint) {
  const PointCloud& all = points.cloud;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!crop || crop->keeps(all.points[i])) kept.push_back(i);
  LivePicture shown;
  shown.points = kept.size();
  const bool grid = points.width > 0 && points.cell.size() == all.size();
  const double excess = double(kept.size()) / double(std::max<std::size_t>(1, most));
  shown.every = std::max(1, int(std::ceil(grid ? std::sqrt(excess) : excess)));
  const Neighbours neighbours(points);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t i = kept[k];
    const bool taken = grid ? points.cell[i] / points.width % shown.every == 0 &&
                                  points.cell[i] % points.width % shown.every == 0
                            : k % std::size_t(shown.every) == 0;
    if (!taken) continue;
    const auto tinted = tint ? tint(all.points[i]) : std::nullopt;
    shown.cloud.points.push_back(all.points[i]);
    shown.cloud.colors.push_back(tinted               ? neighbours.shaded(i, *tinted)
                                 : all.colors.empty() ? neighbours.shaded(i, kPlain)
                                                      : all.colors[i]);
  }
  return shown;
}

DrawablePtr make_drawable(const LivePicture& picture, double pixel_rad) {
  const Box box = bounds(picture.cloud.points);
  const double away = box.empty() ? 0.0 : box.center().norm();
  return make_drawable(picture.cloud, pixel_rad * picture.every * away);
}

}  // namespace turnscan::studio
