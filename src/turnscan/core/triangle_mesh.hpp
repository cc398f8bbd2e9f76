#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

struct MeshTexture;

/// Indexed triangles, metres, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec3f> normals;  ///< per vertex or empty
  std::vector<Rgb> colors;     ///< per vertex or empty
  std::string name;            ///< object name in formats that have one; may be empty
  /// Or nullptr; copies share it. See core/mesh_texture.hpp.
  std::shared_ptr<const MeshTexture> texture = nullptr;

  bool empty() const { return triangles.empty(); }
};

/// Axis-aligned box; empty when min > max.
struct Box {
  Vec3d min = Vec3d::Constant(1e300);
  Vec3d max = Vec3d::Constant(-1e300);

  bool empty() const { return (min.array() > max.array()).any(); }
  Vec3d size() const { return empty() ? Vec3d::Zero() : Vec3d(max - min); }
  Vec3d center() const { return 0.5 * (min + max); }
  void add(const Vec3d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
};

Box bounds(const std::vector<Vec3f>& points);

/// Fails with kFormat when a triangle names a vertex that does not exist, a vertex that a triangle
/// names is not finite, or normals or colours do not fit the vertices. `what` begins the message.
Result<> validate_mesh(const TriangleMesh& mesh, std::string_view what = "mesh");

}  // namespace turnscan
