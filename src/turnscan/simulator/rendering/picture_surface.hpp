#pragma once
// Colour and normal of a mesh at a hit.

#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <vector>

namespace turnscan::rendering {

/// Refers to the mesh, which must outlive it.
class PictureSurface {
 public:
  PictureSurface(const TriangleMesh& mesh, bool smooth);

  /// Interpolated from the faces about each corner that are within 40 deg of the one hit, so that
  /// edges stay sharp; without smooth, the hit's own normal. Unit length, on the side of the hit's
  /// normal.
  Vec3f normal(const RayHit& hit) const;
  /// Linear light, from the texture, else vertex colours; `otherwise` if there are none.
  Vec3f albedo(const RayHit& hit, const Vec3f& otherwise) const;

 private:
  Vec3f corner_normal(std::uint32_t vertex, const Vec3f& face_normal) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> first_;  // per vertex, index of its first entry in around_; empty: not
                                      // smooth
  std::vector<std::uint32_t> around_;  // triangles around the vertices
};

/// sRGB transfer (IEC 61966-2-1), approximated by the power law 2.2.
Vec3f linear_of(Rgb color);
Rgb rgb_of(const Vec3f& linear);

}  // namespace turnscan::rendering
