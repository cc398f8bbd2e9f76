#pragma once
// The texture of a triangle mesh.

#include <array>
#include <memory>
#include <turnscan/core/eigen.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Texture coordinates are stored per corner of a triangle. So vertices are not split along the
/// seams of the texture, and a closed mesh remains closed.
struct MeshTexture {
  ColorImage image;  ///< sRGB
  /// Per triangle and corner, in glTF's convention: (0, 0) is the upper left corner of the image,
  /// (1, 1) the lower right one. Coordinates beyond [0, 1] repeat the image.
  std::vector<std::array<Eigen::Vector2f, 3>> corners;
};

/// Whether the mesh has a texture that matches its triangles; it does not after they change.
bool has_texture(const TriangleMesh& mesh);

/// sRGB, 0 to 255, bilinear between the centres of the pixels, by the values as they are stored.
Vec3f texture_at(const ColorImage& image, const Eigen::Vector2f& uv);

/// The same at barycentric coordinates (1 - u - v) a + u b + v c of a triangle. Precondition:
/// has_texture(mesh), and the triangle exists.
Vec3f texture_at(const TriangleMesh& mesh, std::uint32_t triangle, float u, float v);

/// A mesh whose vertices are split along the seams of the texture, with texture coordinates per
/// vertex, as most file formats need it. Normals and colours are copied.
struct SplitMesh {
  TriangleMesh mesh;  ///< without texture
  std::vector<Eigen::Vector2f> uvs;
};
SplitMesh split_at_seams(const TriangleMesh& mesh);  ///< precondition: has_texture(mesh)

/// The inverse, in place: joins vertices that are equal in position (and in normal and colour where
/// there are any) and drops those that no triangle names. Precondition: has_texture(mesh).
void weld_seams(TriangleMesh& mesh);

}  // namespace turnscan
