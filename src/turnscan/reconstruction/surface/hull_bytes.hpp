#pragma once
// Data exchanged with the program turnscan-concave-hull. Bytes in the machine's order, since both
// ends are built together.

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::surface {

/// x, y, z of each point.
inline std::string bytes_of_points(const std::vector<Vec3f>& points) {
  std::string bytes(points.size() * sizeof(Vec3f), '\0');
  if (!points.empty()) std::memcpy(bytes.data(), points.data(), bytes.size());
  return bytes;
}

/// nullopt unless the bytes contain whole points.
inline std::optional<std::vector<Vec3f>> points_from_bytes(std::string_view bytes) {
  if (bytes.size() % sizeof(Vec3f) != 0) return std::nullopt;
  std::vector<Vec3f> points(bytes.size() / sizeof(Vec3f));
  if (!points.empty()) std::memcpy(points.data()->data(), bytes.data(), bytes.size());
  return points;
}

/// The numbers of vertices and of triangles, x, y, z of each vertex, the corners of each triangle.
inline std::string bytes_of_mesh(const TriangleMesh& mesh) {
  const std::uint64_t sizes[2] = {mesh.vertices.size(), mesh.triangles.size()};
  std::string bytes(reinterpret_cast<const char*>(sizes), sizeof sizes);
  bytes += bytes_of_points(mesh.vertices);
  bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()),
               mesh.triangles.size() * sizeof(mesh.triangles[0]));
  return bytes;
}

/// nullopt unless the bytes are those of a mesh.
inline std::optional<TriangleMesh> mesh_from_bytes(std::string_view bytes) {
  TriangleMesh mesh;
  constexpr std::size_t kVertex = sizeof(Vec3f), kTriangle = sizeof(mesh.triangles[0]);
  std::uint64_t sizes[2];
  if (bytes.size() < sizeof sizes) return std::nullopt;
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  bytes.remove_prefix(sizeof sizes);
  if (sizes[0] > bytes.size() / kVertex || sizes[1] > bytes.size() / kTriangle ||
      bytes.size() != sizes[0] * kVertex + sizes[1] * kTriangle)
    return std::nullopt;
  mesh.vertices = *points_from_bytes(bytes.substr(0, sizes[0] * kVertex));
  mesh.triangles.resize(sizes[1]);
  if (!mesh.triangles.empty())
    std::memcpy(mesh.triangles.data(), bytes.data() + sizes[0] * kVertex, sizes[1] * kTriangle);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle)
      if (corner >= mesh.vertices.size()) return std::nullopt;
  }
  return mesh;
}

}  // namespace turnscan::surface
