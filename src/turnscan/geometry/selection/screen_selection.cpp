#include <turnscan/geometry/selection/screen_selection.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <turnscan/core/parallel.hpp>

namespace turnscan {

namespace {

/// A point on the screen and its distance from the camera; w <= 0: behind it.
struct Seen {
  double x = 0.0, y = 0.0, w = 0.0;
};

Seen see(const ScreenView& view, const Vec3d& p) {
  const Eigen::Vector4d q = view.to_pixels * p.homogeneous();
  if (!(q.w() > 1e-9)) return {};
  return {q.x() / q.w(), q.y() / q.w(), q.w()};
}

std::vector<Seen> see_all(const ScreenView& view, std::span<const Vec3f> points) {
  std::vector<Seen> out(points.size());
  parallel_for(points.size(), 4096,
               [&](std::size_t i) { out[i] = see(view, points[i].cast<double>()); });
  return out;
}

/// Size in metres of a pixel at one metre from the camera.
double metres_per_pixel(const ScreenView& view) {
  const Vec3d forward = view.to_pixels.block<1, 3>(3, 0).transpose().normalized();
  const Vec3d row = view.to_pixels.block<1, 3>(0, 0).transpose();
  return 1.0 / std::max(1e-9, (row - row.dot(forward) * forward).norm());
}

/// The pixel of a point, or -1 outside the screen.
std::ptrdiff_t pixel_of(const Seen& at, int width, int height) {
  if (!(at.w > 0.0) || !(at.x >= 0.0) || !(at.y >= 0.0) || !(at.x < width) || !(at.y < height))
    return -1;
  return std::ptrdiff_t(at.y) * width + std::ptrdiff_t(at.x);
}

/// The nearest triangle in each pixel, and its distance.
class SeenTriangles {
 public:
  SeenTriangles(const TriangleMesh& mesh, const ScreenView& view)
      : mesh_(mesh),
        width_(view.width),
        height_(view.height),
        pixel_m_(metres_per_pixel(view)),
        seen_(see_all(view, mesh.vertices)),
        nearness_(std::size_t(width_) * std::size_t(height_), 0.0f),
        first_(nearness_.size(), kNobody) {}

  /// Draws all triangles.
  Result<> draw(const RunContext& context) {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (t % 65536 == 0) TURNSCAN_TRY(context.check());
      if (before_camera(t)) draw_triangle(t);
    }
    return {};
  }

  const Seen& corner(std::size_t t, std::size_t c) const { return seen_[mesh_.triangles[t][c]]; }

  bool before_camera(std::size_t t) const {
    return corner(t, 0).w > 0.0 && corner(t, 1).w > 0.0 && corner(t, 2).w > 0.0;
  }

  /// Whether nothing occludes a point on triangle t.
  bool in_sight(std::size_t t, const Seen& place) const {
    const std::ptrdiff_t pixel = drawn_pixel(pixel_of(place, width_, height_));
    if (pixel < 0) return pixel_of(place, width_, height_) >= 0;
    const std::uint32_t front = first_[std::size_t(pixel)];
    if (front == t) return true;
    // Neighbours in one surface have the same orientation; a thin wall has its other side behind
    // it.
    if ((doubled_area(front) < 0.0) != (doubled_area(t) < 0.0)) return false;
    // Both at the centre of the pixel: on slopes the distance varies within it.
    constexpr double kSlackPixels = 1.5;
    const double x = double(pixel % width_) + 0.5, y = double(pixel / width_) + 0.5;
    return distance_at(t, x, y) <=
           1.0 / double(nearness_[std::size_t(pixel)]) + kSlackPixels * pixel_m_ * place.w;
  }

  void mark_touched(const std::vector<std::uint8_t>& mask, Selection& out) const {
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask[i] != 0 && first_[i] != kNobody) out[first_[i]] = 1;
  }

 private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  /// The pixel, or if its centre is beside everything that is drawn, the nearest of its drawn
  /// neighbours; -1: none.
  std::ptrdiff_t drawn_pixel(std::ptrdiff_t pixel) const {
    if (pixel < 0 || first_[std::size_t(pixel)] != kNobody) return pixel;
    const std::ptrdiff_t x = pixel % width_, y = pixel / width_;
    for (const auto& [dx, dy] :
         {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= width_ || y + dy >= height_) continue;
      const std::ptrdiff_t other = (y + dy) * width_ + x + dx;
      if (first_[std::size_t(other)] != kNobody) return other;
    }
    return -1;
  }

  double doubled_area(std::size_t t) const {
    const Seen &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  }

  /// Distance of the plane of the triangle there. 1 / w is linear on the screen.
  double distance_at(std::size_t t, double x, double y) const {
    const Seen &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    const double area = doubled_area(t);
    const double v = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
    const double u = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
    const double nearness = (1.0 - v - u) / a.w + v / b.w + u / c.w;
    return nearness > 0.0 ? 1.0 / nearness : std::numeric_limits<double>::infinity();
  }

  void draw_triangle(std::size_t t) {
    const Seen &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    const double area = doubled_area(t);
    if (area == 0.0 || !std::isfinite(area)) return;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const auto clamped = [](double value, int most) {
      return int(std::clamp(value, 0.0, double(most)));
    };
    // A pixel is drawn if its centre is inside.
    const int x0 = clamped(std::ceil(left - 0.5), width_),
              y0 = clamped(std::ceil(top - 0.5), height_);
    const int x1 = clamped(std::floor(right - 0.5) + 1.0, width_);
    const int y1 = clamped(std::floor(bottom - 0.5) + 1.0, height_);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double v = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
        const double u = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
        if (v < 0.0 || u < 0.0 || u + v > 1.0) continue;
        const auto nearness = float((1.0 - v - u) / a.w + v / b.w + u / c.w);
        const std::size_t at = std::size_t(y) * std::size_t(width_) + std::size_t(x);
        if (!(nearness > nearness_[at])) continue;
        nearness_[at] = nearness;
        first_[at] = std::uint32_t(t);
      }
  }

  const TriangleMesh& mesh_;
  int width_, height_;
  double pixel_m_;
  std::vector<Seen> seen_;
  std::vector<float> nearness_;  // 1 / distance; 0: nothing there
  std::vector<std::uint32_t> first_;
};

void mask_outline(const std::vector<Eigen::Vector2d>& outline, int width, int height,
                  std::vector<std::uint8_t>& mask) {
  std::vector<double> crossings;
  for (int y = 0; y < height; ++y) {
    crossings.clear();
    const double py = y + 0.5;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      const Eigen::Vector2d &a = outline[i], &b = outline[j];
      if ((a.y() > py) == (b.y() > py)) continue;
      crossings.push_back(a.x() + (b.x() - a.x()) * (py - a.y()) / (b.y() - a.y()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto pixel = [&](double x) {
        return std::ptrdiff_t(std::clamp(std::ceil(x - 0.5), 0.0, double(width)));
      };
      const auto row = mask.begin() + std::ptrdiff_t(y) * width;
      std::fill(row + pixel(crossings[i]), row + pixel(crossings[i + 1]), std::uint8_t{1});
    }
  }
}

void mask_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, int width,
                  int height, std::vector<std::uint8_t>& mask) {
  const auto range = [radius](double u, double v, int most) {
    const auto [low, high] = std::minmax(u, v);
    return std::pair{int(std::clamp(std::floor(low - radius), 0.0, double(most))),
                     int(std::clamp(std::ceil(high + radius) + 1.0, 0.0, double(most)))};
  };
  const auto [x0, x1] = range(a.x(), b.x(), width);
  const auto [y0, y1] = range(a.y(), b.y(), height);
  const Eigen::Vector2d way = b - a;
  const double squared = way.squaredNorm();
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const Eigen::Vector2d p(x + 0.5, y + 0.5);
      const double t = squared > 0.0 ? std::clamp((p - a).dot(way) / squared, 0.0, 1.0) : 0.0;
      if ((p - a - t * way).squaredNorm() <= radius * radius)
        mask[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 1;
    }
}

}  // namespace

std::vector<std::uint8_t> region_mask(const ScreenRegion& region, int width, int height) {
  std::vector<std::uint8_t> mask(std::size_t(std::max(0, width)) * std::size_t(std::max(0, height)),
                                 0);
  if (region.points.empty() || mask.empty()) return mask;
  if (!(region.radius_px > 0.0)) {
    mask_outline(region.points, width, height, mask);
    return mask;
  }
  for (std::size_t i = 0; i < region.points.size(); ++i)
    mask_segment(region.points[i == 0 ? 0 : i - 1], region.points[i], region.radius_px, width,
                 height, mask);
  return mask;
}

Result<Selection> select_on_screen(const TriangleMesh& mesh, const ScreenRegion& region,
                                   const ScreenView& view, bool visible_only,
                                   const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh, "selection"));
  const auto mask = region_mask(region, view.width, view.height);
  const bool brush = region.radius_px > 0.0;
  SeenTriangles seen(mesh, view);
  if (visible_only || brush) TURNSCAN_TRY(seen.draw(context));
  Selection out(mesh.triangles.size(), 0);
  TURNSCAN_TRY(parallel_for(out.size(), 4096, context, [&](std::size_t t) {
    if (!seen.before_camera(t)) return;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3d middle = (mesh.vertices[a].cast<double>() + mesh.vertices[b].cast<double>() +
                          mesh.vertices[c].cast<double>()) /
                         3.0;
    const auto picked = [&](const Seen& place) {
      const std::ptrdiff_t pixel = pixel_of(place, view.width, view.height);
      return pixel >= 0 && mask[std::size_t(pixel)] != 0 &&
             (!visible_only || seen.in_sight(t, place));
    };
    bool in = picked(see(view, middle));
    for (std::size_t i = 0; brush && !in && i < 3; ++i) in = picked(seen.corner(t, i));
    out[t] = in ? 1 : 0;
  }));
  if (brush) seen.mark_touched(mask, out);
  return out;
}

Result<Selection> select_on_screen(std::span<const Vec3f> points, const ScreenRegion& region,
                                   const ScreenView& view, bool visible_only,
                                   const RunContext& context) {
  // A cloud has gaps between its points: each occludes what is behind its surroundings.
  constexpr int kCellPixels = 6;
  constexpr double kSlackCells = 4.0;
  const auto mask = region_mask(region, view.width, view.height);
  const std::vector<Seen> seen = see_all(view, points);
  TURNSCAN_TRY(context.check());
  const int columns = view.width / kCellPixels + 1, rows = view.height / kCellPixels + 1;
  std::vector<double> nearest(std::size_t(columns) * std::size_t(rows),
                              std::numeric_limits<double>::infinity());
  const auto cell_of = [&](const Seen& p) {
    return std::array{int(p.x) / kCellPixels, int(p.y) / kCellPixels};
  };
  for (const Seen& p : seen) {
    if (!visible_only || pixel_of(p, view.width, view.height) < 0) continue;
    const auto [column, row] = cell_of(p);
    double& there = nearest[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    there = std::min(there, p.w);
  }
  const double slack = kSlackCells * kCellPixels * metres_per_pixel(view);
  Selection out(points.size(), 0);
  TURNSCAN_TRY(parallel_for(points.size(), 4096, context, [&](std::size_t i) {
    const std::ptrdiff_t pixel = pixel_of(seen[i], view.width, view.height);
    if (pixel < 0 || mask[std::size_t(pixel)] == 0) return;
    const auto [column, row] = cell_of(seen[i]);
    const double front = nearest[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    out[i] = !visible_only || seen[i].w <= front * (1.0 + slack) ? 1 : 0;
  }));
  return out;
}

}  // namespace turnscan
