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

std::size_t parts_of(const ModelData& data) {
  return data.kind == ModelKind::kMesh ? data.mesh.triangles.size() : data.cloud.size();
}

/// For a mesh, slightly offset on both sides so that it covers the mesh.
DrawablePtr selection_drawable(const ModelData& data, const Selection& selection) {
  if (count_selected(selection) == 0) return nullptr;
  if (data.kind == ModelKind::kCloud) {
    PointCloud part;
    for (std::size_t i = 0; i < selection.size(); ++i)
      if (selection[i] != 0) part.points.push_back(data.cloud.points[i]);
    return make_drawable(part);
  }
  const TriangleMesh& mesh = data.mesh;
  const auto off = float(0.0006 * bounds(mesh.vertices).size().norm());
  TriangleMesh part;
  for (std::size_t t = 0; t < selection.size(); ++t) {
    if (selection[t] == 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f normal = (mesh.vertices[b] - mesh.vertices[a])
                             .cross(mesh.vertices[c] - mesh.vertices[a])
                             .normalized();
    for (const float side : {off, -off}) {
      const auto first = std::uint32_t(part.vertices.size());
      for (const std::uint32_t v : {a, b, c}) {
        part.vertices.push_back(mesh.vertices[v] + side * normal);
        part.normals.push_back(normal);
      }
      part.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return make_drawable(part);
}

}  // namespace turnscan::studio
