#include <algorithm>
#include <cmath>
#include <numeric>
#include <turnscan/reconstruction/passes/samples.hpp>

namespace turnscan::passes {

namespace {

/// A voxel and the octant of the normal.
std::uint64_t voxel_key(const Vec3f& p, const Vec3f& n, double cell_m) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const auto at = std::int64_t(std::floor(double(p[k]) / cell_m)) + (std::int64_t(1) << 19);
    key = key << 20 | (std::uint64_t(at) & 0xfffffu);
  }
  for (int k = 0; k < 3; ++k) key = key << 1 | (n[k] < 0.0f ? 1u : 0u);
  return key;
}

}  // namespace

Samples thinned(const PassSurface& surface, std::size_t count) {
  const double area = std::accumulate(surface.areas.begin(), surface.areas.end(), 0.0);
  // A plane crosses about 1.5 voxels per cell of its area.
  const double cell = std::sqrt(1.5 * area / double(count));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(surface.points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = {voxel_key(surface.points[i], surface.normals[i], cell), std::uint32_t(i)};
  std::sort(order.begin(), order.end());
  Samples out;
  out.spacing_m = cell;
  for (std::size_t i = 0; i < order.size();) {
    Vec3f point = Vec3f::Zero(), normal = Vec3f::Zero(), color = Vec3f::Zero();
    float sum = 0.0f, colored = 0.0f;
    for (const std::uint64_t key = order[i].first; i < order.size() && order[i].first == key; ++i) {
      const std::uint32_t v = order[i].second;
      point += surface.areas[v] * surface.points[v];
      normal += surface.areas[v] * surface.normals[v];
      sum += surface.areas[v];
      if (surface.colors.empty() || !surface.colors[v].allFinite()) continue;
      color += surface.areas[v] * surface.colors[v];
      colored += surface.areas[v];
    }
    if (!(sum > 0.0f) || !(normal.norm() > 0.3f * sum)) continue;
    out.points.push_back(point / sum);
    out.normals.push_back(normal.normalized());
    out.areas.push_back(sum);
    if (!surface.colors.empty()) out.colors.push_back(color / colored);  // NaN if none is known
  }
  return out;
}

NearestGrid::NearestGrid(const Samples& samples, int side, double reach_m) {
  const Box box = bounds(samples.points);
  const double cell = (box.size().maxCoeff() + 2.0 * reach_m) / side;
  origin_ = (box.min.array() - reach_m).matrix().cast<float>();
  per_cell_ = float(1.0 / cell);
  size_ = ((box.size().array() + 2.0 * reach_m) / cell).ceil().cast<int>().max(1).matrix();
  nearest_.assign(std::size_t(size_.x()) * std::size_t(size_.y()) * std::size_t(size_.z()), kNone);
  std::vector<float> squared(nearest_.size(), float(reach_m * reach_m));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3f at = (samples.points[i] - origin_) * per_cell_;
    const Eigen::Vector3i low = ((at.array() - float(reach_m) * per_cell_).cast<int>()).max(0);
    const Eigen::Vector3i high =
        ((at.array() + float(reach_m) * per_cell_).cast<int>()).min(size_.array() - 1);
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          const Vec3f middle(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f);
          const float distance = (middle - at).squaredNorm() / (per_cell_ * per_cell_);
          const auto at_cell = std::size_t(x + size_.x() * (y + size_.y() * z));
          if (distance >= squared[at_cell]) continue;
          squared[at_cell] = distance;
          nearest_[at_cell] = std::uint32_t(i);
        }
      }
    }
  }
}

}  // namespace turnscan::passes
