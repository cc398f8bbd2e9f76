#pragma once
// Small edits that keep a mesh's attributes in step with its vertices.

#include <cstdint>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <utility>
#include <vector>

namespace turnscan::mesh {

/// Appends a copy of vertex v and returns its index.
std::uint32_t duplicate_vertex(TriangleMesh& mesh, std::uint32_t v);

/// Appends a vertex at the mean of others, with their mean normal and colour.
std::uint32_t add_mean_vertex(TriangleMesh& mesh, std::span<const std::uint32_t> of);

/// Removes the triangles with drop[t] != 0 and keeps the order of the rest.
void drop_triangles(TriangleMesh& mesh, const std::vector<std::uint8_t>& drop);

/// Removes unreferenced vertices and keeps the order of the rest.
void compact_vertices(TriangleMesh& mesh);

/// The listed triangles, in that order, with the vertices they reference, in the order of mesh.
TriangleMesh extract(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

/// Twice the triangle's area times its normal.
inline Vec3d doubled_area_normal(const TriangleMesh& mesh, std::size_t t) {
  const Vec3d a = mesh.vertices[mesh.triangles[t][0]].cast<double>();
  const Vec3d b = mesh.vertices[mesh.triangles[t][1]].cast<double>();
  const Vec3d c = mesh.vertices[mesh.triangles[t][2]].cast<double>();
  return (b - a).cross(c - a);
}

}  // namespace turnscan::mesh
