#pragma once
// A picture on the surface of a mesh.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Places in the picture per corner of a triangle, so that a seam of the picture is none of the
/// mesh: its vertices stay joined, and what checks or repairs meshes sees them closed.
struct MeshTexture {
  ColorImage image;  ///< sRGB
  /// Per triangle and corner, glTF's convention: (0, 0) is the upper left corner of the picture,
  /// (1, 1) the lower right one. Places beyond [0, 1] repeat the picture.
  std::vector<std::array<Eigen::Vector2f, 3>> corners;
};

/// Whether the mesh has a texture that fits its triangles: it is lost when triangles change.
bool has_texture(const TriangleMesh& mesh);

/// sRGB, 0 to 255, bilinear between the centres of the pixels, by the values as they are stored.
Vec3f texture_at(const ColorImage& image, const Eigen::Vector2f& uv);

/// The same at barycentric coordinates (1 - u - v) a + u b + v c of a triangle. Precondition:
/// has_texture(mesh), and the triangle exists.
Vec3f texture_at(const TriangleMesh& mesh, std::uint32_t triangle, float u, float v);

/// A mesh whose vertices are split where the texture has its seams, and a place per vertex: as most
/// files want it. Normals and colours are copied. Precondition: has_texture(mesh).
struct SplitMesh {
  TriangleMesh mesh;  ///< without texture
  std::vector<Eigen::Vector2f> uvs;
};
SplitMesh split_at_seams(const TriangleMesh& mesh);

/// The inverse, in place: joins vertices that are equal in position (and in normal and colour where
/// there are any) and drops those that no triangle names. Precondition: has_texture(mesh).
void weld_seams(TriangleMesh& mesh);

}  // namespace turnscan
