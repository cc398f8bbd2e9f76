#pragma once
// Clips a mesh by a plane and closes the cut.

#include <array>
#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// The points p with normal . p >= offset_m.
struct HalfSpace {
  Vec3d normal = Vec3d::UnitY();  ///< unit length
  double offset_m = 0.0;
};

struct ClippedMesh {
  static constexpr std::uint32_t kCutFace = ~0u;

  TriangleMesh mesh;
  /// Per triangle: the triangle of the input that it is or was part of, or kCutFace.
  std::vector<std::uint32_t> source;
  /// Per vertex: the ends of the input edge that contains it; twice the same index for original
  /// vertices.
  std::vector<std::array<std::uint32_t, 2>> vertex_source;
  double cut_area_m2 = 0.0;  ///< of the cut faces
  /// The cut was closed outline by outline, since outlines cross each other; the faces do so, too.
  bool outlines_cross = false;
};

/// The part of the mesh inside the half space. If the mesh was closed, 2-manifold and consistently
/// oriented, so is the result: cut faces get the constrained Delaunay triangulation of their
/// outlines, including holes in them. Otherwise the cut stays open. Vertices within a micrometre of
/// the plane count as inside; new vertices are on edges, with the ends' mean colour. Normals are
/// recomputed if there are any. If nothing is inside: an empty mesh. Fails with kFormat as
/// validate_mesh(), with kInvalidOption if the normal is not of unit length.
Result<ClippedMesh> clip(const TriangleMesh& mesh, const HalfSpace& inside);

}  // namespace turnscan
