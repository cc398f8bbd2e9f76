#include "view/creases.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

namespace turnscan::studio {

namespace {

/// Triangles around each vertex, as concatenated lists.
struct Fans {
  std::vector<std::uint32_t> first, triangles;

  explicit Fans(const TriangleMesh& mesh) : first(mesh.vertices.size() + 1, 0) {
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) ++first[v + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    triangles.resize(3 * mesh.triangles.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) triangles[next[v]++] = t;
  }
};

}  // namespace

TriangleMesh split_at_creases(const TriangleMesh& mesh, double angle_rad) {
  TriangleMesh out = mesh;
  out.normals = vertex_normals(mesh);
  const auto limit = static_cast<float>(std::cos(angle_rad));
  std::vector<Vec3f> normals(mesh.triangles.size()), unit(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    normals[t] = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    const float length = normals[t].norm();
    unit[t] = length > 0.0f ? Vec3f(normals[t] / length) : Vec3f(Vec3f::Zero());
  }
  const Fans fans(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t& corner : out.triangles[t]) {
      const std::uint32_t v = corner;
      const auto begin = fans.triangles.begin() + fans.first[v],
                 end = fans.triangles.begin() + fans.first[v + 1];
      Vec3f side = Vec3f::Zero();
      bool crease = false;
      for (auto at = begin; at != end; ++at) {
        const bool same = unit[t].dot(unit[*at]) >= limit;
        crease = crease || !same;
        if (same) side += normals[*at];
      }
      if (!crease || side.isZero()) continue;
      corner = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(mesh.vertices[v]);
      out.normals.push_back(side.normalized());
      if (!mesh.colors.empty()) out.colors.push_back(mesh.colors[v]);
    }
  }
  return out;
}

}  // namespace turnscan::studio
