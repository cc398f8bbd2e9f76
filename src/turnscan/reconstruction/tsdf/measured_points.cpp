#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/measured_points.hpp>

namespace turnscan::tsdf {

namespace {

/// Coordinates of points, axis by axis.
using Columns = std::array<std::vector<float>, 3>;

constexpr double kStray = 2e-4;             // share of the points, on each side
constexpr std::size_t kViewsPerBatch = 16;  // whose points are stored twice
constexpr std::size_t kMaxPoints = 4'000'000;

void append(Columns& all, Columns& more) {
  for (std::size_t a = 0; a < 3; ++a) {
    all[a].insert(all[a].end(), more[a].begin(), more[a].end());
    more[a] = {};
  }
}

Box robust_box(Columns& columns) {
  Box box;
  if (columns[0].empty()) return box;
  parallel_for(3, 1, [&](std::size_t a) {
    auto& column = columns[a];
    const auto cut = std::ptrdiff_t(kStray * double(column.size()));
    std::nth_element(column.begin(), column.begin() + cut, column.end());
    box.min[int(a)] = column[std::size_t(cut)];
    std::nth_element(column.begin(), column.end() - 1 - cut, column.end());
    box.max[int(a)] = *(column.end() - 1 - cut);
  });
  return box;
}

}  // namespace

Box measured_box(std::span<const views::DepthView> views, const std::optional<Cylinder>& cylinder,
                 std::size_t most_views) {
  const std::size_t stride = view_stride(views.size(), most_views);
  const std::size_t count = (views.size() + stride - 1) / stride;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < count; ++v) kept += views[v * stride].kept;
  const std::size_t step = 1 + kept / kMaxPoints;  // stride for thinning the points
  Columns points;
  for (std::size_t first = 0; first < count; first += kViewsPerBatch) {
    std::vector<Columns> own(std::min(kViewsPerBatch, count - first));
    parallel_for(own.size(), 1, [&](std::size_t v) {
      const auto take = [&](const Vec3f& p) {
        for (int a = 0; a < 3; ++a) own[v][std::size_t(a)].push_back(p[a]);
      };
      for_each_point(views[(first + v) * stride], cylinder, take, step);
    });
    for (Columns& one : own) append(points, one);
  }
  return robust_box(points);
}

}  // namespace turnscan::tsdf
