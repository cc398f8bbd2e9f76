#include <algorithm>
#include <cmath>
#include <turnscan/geometry/mesh/mesh_edit.hpp>

namespace turnscan::mesh {

namespace {

/// Renumbers the vertices that triangles use from 0, in their order; calls take(v) for each of
/// them.
template <class Triangles, class Take>
void number_used(Triangles& triangles, std::size_t vertices, const Take& take) {
  std::vector<std::uint32_t> place(vertices, 0);
  for (const auto& t : triangles) {
    for (const std::uint32_t v : t) place[v] = 1;
  }
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0) continue;
    take(v);
    place[v] = count++;
  }
  for (auto& t : triangles) {
    for (std::uint32_t& v : t) v = place[v];
  }
}

}  // namespace

std::uint32_t duplicate_vertex(TriangleMesh& mesh, std::uint32_t v) {
  const auto index = std::uint32_t(mesh.vertices.size());
  const Vec3f position = mesh.vertices[v];
  mesh.vertices.push_back(position);
  if (!mesh.normals.empty()) {
    const Vec3f normal = mesh.normals[v];
    mesh.normals.push_back(normal);
  }
  if (!mesh.colors.empty()) {
    const Rgb color = mesh.colors[v];
    mesh.colors.push_back(color);
  }
  return index;
}

std::uint32_t add_mean_vertex(TriangleMesh& mesh, std::span<const std::uint32_t> of) {
  const auto index = std::uint32_t(mesh.vertices.size());
  const double scale = 1.0 / double(of.size());
  Vec3d position = Vec3d::Zero(), normal = Vec3d::Zero(), color = Vec3d::Zero();
  for (const std::uint32_t v : of) {
    position += scale * mesh.vertices[v].cast<double>();
    if (!mesh.normals.empty()) normal += mesh.normals[v].cast<double>();
    if (mesh.colors.empty()) continue;
    const Rgb& c = mesh.colors[v];
    color += scale * Vec3d(c.r, c.g, c.b);
  }
  mesh.vertices.push_back(position.cast<float>());
  if (!mesh.normals.empty()) mesh.normals.push_back(normal.normalized().cast<float>());
  if (!mesh.colors.empty()) {
    const auto byte = [&](int i) { return std::uint8_t(std::lround(color[i])); };
    mesh.colors.push_back({byte(0), byte(1), byte(2)});
  }
  return index;
}

void drop_triangles(TriangleMesh& mesh, const std::vector<std::uint8_t>& drop) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (drop[t] == 0) mesh.triangles[kept++] = mesh.triangles[t];
  }
  mesh.triangles.resize(kept);
}

void compact_vertices(TriangleMesh& mesh) {
  std::uint32_t count = 0;
  number_used(mesh.triangles, mesh.vertices.size(), [&](std::uint32_t v) {
    mesh.vertices[count] = mesh.vertices[v];
    if (!mesh.normals.empty()) mesh.normals[count] = mesh.normals[v];
    if (!mesh.colors.empty()) mesh.colors[count] = mesh.colors[v];
    ++count;
  });
  mesh.vertices.resize(count);
  if (!mesh.normals.empty()) mesh.normals.resize(count);
  if (!mesh.colors.empty()) mesh.colors.resize(count);
}

TriangleMesh extract(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  TriangleMesh part;
  part.name = mesh.name;
  part.triangles.reserve(triangles.size());
  for (const std::uint32_t t : triangles) part.triangles.push_back(mesh.triangles[t]);
  const auto take = [&](std::uint32_t v) {
    part.vertices.push_back(mesh.vertices[v]);
    if (!mesh.normals.empty()) part.normals.push_back(mesh.normals[v]);
    if (!mesh.colors.empty()) part.colors.push_back(mesh.colors[v]);
  };
  // A table of all vertices is faster than sorting, but not for each of many crumbs.
  if (triangles.size() >= mesh.vertices.size() / 16) {
    number_used(part.triangles, mesh.vertices.size(), take);
    return part;
  }
  std::vector<std::uint32_t> used;
  used.reserve(3 * triangles.size());
  for (const auto& t : part.triangles) used.insert(used.end(), t.begin(), t.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t v : used) take(v);
  for (auto& t : part.triangles) {
    for (std::uint32_t& v : t) {
      v = std::uint32_t(std::lower_bound(used.begin(), used.end(), v) - used.begin());
    }
  }
  return part;
}

}  // namespace turnscan::mesh
