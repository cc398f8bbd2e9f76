#pragma once
// The points that views measured, and their bounding box.

#include <limits>
#include <optional>
#include <span>
#include <turnscan/reconstruction/views/depth_view.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::tsdf {

/// Calls take(p_table) for every step-th point that a view measured, within the cylinder if there
/// is one; edges are excluded.
template <class Take>
void for_each_point(const views::DepthView& view, const std::optional<Cylinder>& cylinder,
                    const Take& take, std::size_t step = 1) {
  const Eigen::Matrix3f back = view.rotation.transpose();
  std::size_t n = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t word = view.pixels[std::size_t(y) * std::size_t(view.width) + x];
      if ((word & 0xffffu) == 0 || (word & views::DepthView::kEdge) != 0) continue;
      if (n++ % step != 0) continue;
      const float z = float(word & 0xffffu) * view.unit_m + view.bias_m;
      const float s = view.parallel ? 1.0f : z;
      const Vec3f p =
          back * (Vec3f((float(x) - view.cx) / view.fx * s, (float(y) - view.cy) / view.fy * s, z) -
                  view.translation);
      if (!cylinder || cylinder->contains(p.cast<double>())) take(p);
    }
  }
}

/// Bounding box of the points of about most_views of the views, evenly spread, without the
/// outermost 2 in 10,000 on each side, which may be outliers. Empty if there are no points.
Box measured_box(std::span<const views::DepthView> views, const std::optional<Cylinder>& cylinder,
                 std::size_t most_views = std::numeric_limits<std::size_t>::max());

/// Stride with which about most_views, at least one, of the views are used.
inline std::size_t view_stride(std::size_t views, std::size_t most_views) {
  return std::max<std::size_t>(1, views / std::max<std::size_t>(1, most_views));
}

}  // namespace turnscan::tsdf
