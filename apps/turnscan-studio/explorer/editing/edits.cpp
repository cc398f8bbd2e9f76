#include "explorer/editing/edits.hpp"

namespace turnscan::studio {

PointCloud points_where(const PointCloud& cloud, const std::function<bool(std::size_t)>& keep) {
  PointCloud out;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!keep(i)) continue;
    out.points.push_back(cloud.points[i]);
    if (!cloud.normals.empty()) out.normals.push_back(cloud.normals[i]);
    if (!cloud.colors.empty()) out.colors.push_back(cloud.colors[i]);
    if (!cloud.weights.empty()) out.weights.push_back(cloud.weights[i]);
    if (!cloud.frame.empty()) out.frame.push_back(cloud.frame[i]);
  }
  return out;
}

PointCloud cut(const PointCloud& cloud, const Vec3d& normal, double offset) {
  return points_where(
      cloud, [&](std::size_t i) { return normal.dot(cloud.points[i].cast<double>()) >= offset; });
}

}  // namespace turnscan::studio
