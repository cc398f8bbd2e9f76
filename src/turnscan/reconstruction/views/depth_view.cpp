#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/views/depth_window.hpp>
#include <turnscan/reconstruction/views/scan_surface.hpp>

namespace turnscan::views {

namespace {

struct PixelBox {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
  void add(int x, int y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  /// The rim around the window shows where the surroundings are empty.
  void widen(int by, int width, int height) {
    x0 = std::max(0, x0 - by), y0 = std::max(0, y0 - by);
    x1 = std::min(width - 1, x1 + by), y1 = std::min(height - 1, y1 + by);
  }
  bool empty() const { return x1 < x0; }
  int width() const { return x1 - x0 + 1; }
  int height() const { return y1 - y0 + 1; }
};

constexpr int kRim = 6;  // pixels

/// The colour of each pixel of the window, as in points_of. The frame matches its sensor.
void take_colors(const Frame& frame, const SensorInfo& sensor, const RayTable& rays,
                 const PixelBox& box, DepthView& view) {
  const auto points = points_of(frame, sensor, rays);
  if (!points || points->cloud.colors.size() != points->cloud.size()) return;
  view.colors.assign(view.pixels.size(), Rgb());
  for (std::size_t i = 0; i < points->cell.size(); ++i) {
    const int x = points->cell[i] % points->width, y = points->cell[i] / points->width;
    if (x < box.x0 || x > box.x1 || y < box.y0 || y > box.y1) continue;
    view.colors[std::size_t(y - box.y0 + 1) * std::size_t(view.width) +
                std::size_t(x - box.x0 + 1)] = points->cloud.colors[i];
  }
}

/// Removes the measurements outside the crop from a window.
void drop_rejected(const SensorInfo& sensor, const RayTable& rays, const PixelBox& box,
                   const KeepPoint& keep, DepthView& view) {
  const auto image_width = std::size_t(sensor.intrinsics.width);
  for (int y = 0; y < box.height(); ++y) {
    for (int x = 0; x < box.width(); ++x) {
      std::uint32_t& word =
          view.pixels[std::size_t(y + 1) * std::size_t(view.width) + std::size_t(x + 1)];
      if ((word & 0xffffu) == 0) continue;
      const std::size_t i = std::size_t(y + box.y0) * image_width + std::size_t(x + box.x0);
      const auto z =
          static_cast<float>((word & 0xffffu) * sensor.depth_unit_m + sensor.depth_bias_m);
      if (!keep(Vec3f(rays.x()[i] * z, rays.y()[i] * z, z))) word &= ~(0xffffu | DepthView::kEdge);
    }
  }
}

/// Space beyond the end of a recorded crop is unknown: in another pass the object may be there.
void end_free_space(const Eigen::Vector4f& plane, const RayTable& rays, int image_width,
                    const PixelBox& box, DepthView& view) {
  constexpr std::uint32_t kUnbounded = 65534;
  for (int y = 0; y < box.height(); ++y) {
    for (int x = 0; x < box.width(); ++x) {
      std::uint32_t& word =
          view.pixels[std::size_t(y + 1) * std::size_t(view.width) + std::size_t(x + 1)];
      if (word >> 17 << 1 != kUnbounded) continue;
      const std::size_t i =
          std::size_t(y + box.y0) * std::size_t(image_width) + std::size_t(x + box.x0);
      const float down = -plane.head<3>().dot(Vec3f(rays.x()[i], rays.y()[i], 1.0f));
      if (!(down > 0.0f)) continue;
      const float end = (plane.w() / down - view.bias_m) / view.unit_m;
      const auto free = std::uint32_t(std::clamp(end, 0.0f, float(kUnbounded)));
      word = DepthView::pack(word & 0xffffu, (word & DepthView::kEdge) != 0, free);
    }
  }
}

DepthView view_of_depth(const Frame& frame, const SensorInfo& sensor, const RayTable& rays,
                        const Pose& T_table_sensor, const ViewScale& scale, const KeepPoint& keep) {
  const DepthImage& depth = frame.depth;
  DepthView view;
  PixelBox box;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(depth.width) + std::size_t(x);
      const std::uint16_t raw = depth.pixels[i];
      if (!measured(raw)) continue;
      ++view.returns;
      const auto z = static_cast<float>(raw * sensor.depth_unit_m + sensor.depth_bias_m);
      if (keep(Vec3f(rays.x()[i] * z, rays.y()[i] * z, z))) {
        ++view.kept;
        box.add(x, y);
      }
    }
  }
  if (box.empty()) return view;
  box.widen(kRim, depth.width, depth.height);
  RawWindow raw(box.width(), box.height());
  for (int y = 0; y < raw.height; ++y) {
    for (int x = 0; x < raw.width; ++x) raw.at(x, y) = depth.at(x + box.x0, y + box.y0);
  }
  const CameraIntrinsics& camera = sensor.intrinsics;
  view.fx = static_cast<float>(camera.fx);
  view.fy = static_cast<float>(camera.fy);
  view.cx = static_cast<float>(camera.cx - box.x0 + 1);
  view.cy = static_cast<float>(camera.cy - box.y0 + 1);
  view.lens = lens_as<float>(camera.lens());
  view.distorted = camera.distorted();
  view.unit_m = static_cast<float>(sensor.depth_unit_m);
  view.bias_m = static_cast<float>(sensor.depth_bias_m);
  set_pose(view, T_table_sensor);
  pack_window(raw, scale.edge_step_m, view);
  if (scale.only_kept) drop_rejected(sensor, rays, box, keep, view);
  if (scale.seen_above) end_free_space(*scale.seen_above, rays, depth.width, box, view);
  if (scale.colored && !frame.color.empty()) take_colors(frame, sensor, rays, box, view);
  return view;
}

/// Triangles between neighbours in the grid, if there is one.
std::vector<std::array<std::uint32_t, 3>> grid_triangles(const FramePoints& points) {
  std::vector<std::array<std::uint32_t, 3>> out;
  if (points.cell.empty()) return out;
  std::vector<std::int32_t> at(std::size_t(points.width) * std::size_t(points.height), -1);
  for (std::size_t i = 0; i < points.cell.size(); ++i)
    at[std::size_t(points.cell[i])] = std::int32_t(i);
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    if (a >= 0 && b >= 0 && c >= 0)
      out.push_back({std::uint32_t(a), std::uint32_t(b), std::uint32_t(c)});
  };
  for (int r = 0; r + 1 < points.height; ++r) {
    for (int c = 0; c + 1 < points.width; ++c) {
      const std::size_t i = std::size_t(r) * std::size_t(points.width) + std::size_t(c);
      const std::size_t below = i + std::size_t(points.width);
      add(at[i], at[i + 1], at[below + 1]);
      add(at[i], at[below + 1], at[below]);
    }
  }
  return out;
}

DepthView view_of_points(FramePoints points, const Pose& T_table_sensor, const ViewScale& scale,
                         const KeepPoint& keep) {
  FramePoints kept;
  kept.width = points.width;
  kept.height = points.height;
  kept.viewpoint = points.viewpoint;
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    if (!keep(points.cloud.points[i])) continue;
    kept.cloud.points.push_back(points.cloud.points[i]);
    if (!points.cell.empty()) kept.cell.push_back(points.cell[i]);
    if (scale.colored && !points.cloud.colors.empty())
      kept.cloud.colors.push_back(points.cloud.colors[i]);
  }
  if (kept.cloud.empty()) return {};
  ScanSurface surface;
  surface.viewpoint = kept.viewpoint;
  surface.points = std::move(kept.cloud.points);
  surface.triangles =
      kept.cell.empty() ? triangle_fans(surface, 3.5 * scale.spacing_m) : grid_triangles(kept);
  surface.colors = std::move(kept.cloud.colors);
  const std::size_t count = surface.points.size();
  // Pixels finer than the points' spacing do not reduce accuracy.
  DepthView view =
      view_of_surface(surface, T_table_sensor, 0.5 * scale.spacing_m, scale.edge_step_m);
  if (view.empty()) return view;
  view.returns = std::uint32_t(points.cloud.size());
  view.kept = std::uint32_t(count);
  return view;
}

}  // namespace

std::size_t views_for_statistics(std::span<const DepthView> views, std::size_t most) {
  constexpr std::size_t kMin = 4;
  constexpr double kMaxPixels = 4e6;
  double pixels = 0.0;
  for (const DepthView& view : views) pixels += double(view.pixels.size());
  const double share = std::min(1.0, kMaxPixels / std::max(pixels, 1.0));
  const std::size_t fitting = std::max(kMin, std::size_t(share * double(views.size())));
  return std::min({views.size(), most, fitting});
}

Viewpoint DepthView::viewpoint() const {
  const Eigen::Matrix3d r = rotation.cast<double>();
  if (parallel) return {-r.transpose() * Vec3d::UnitZ(), true};
  return {-r.transpose() * translation.cast<double>(), false};
}

Result<DepthView> make_view(const Frame& frame, const SensorInfo& sensor, const RayTable& rays,
                            const Pose& T_table_sensor, const ViewScale& scale,
                            const KeepPoint& keep) {
  if (!frame.depth.empty()) {
    if (frame.depth.width != sensor.intrinsics.width ||
        frame.depth.height != sensor.intrinsics.height ||
        rays.x().size() != frame.depth.pixels.size())
      return fail_at(frame.info.file, ErrorCode::kFormat,
                     "depth image is {} x {} pixels, but its sensor has {} x {}", frame.depth.width,
                     frame.depth.height, sensor.intrinsics.width, sensor.intrinsics.height);
    return view_of_depth(frame, sensor, rays, T_table_sensor, scale, keep);
  }
  TURNSCAN_ASSIGN(FramePoints points, points_of(frame, sensor, rays));
  return view_of_points(std::move(points), T_table_sensor, scale, keep);
}

}  // namespace turnscan::views
