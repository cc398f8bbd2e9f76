#pragma once
// Determines the side of a mesh on which a point is, from the nearest point on the mesh.

#include <array>
#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// The normals of a mesh's faces, edges and vertices: an edge's is the sum of its faces', a
/// vertex's the sum of its faces' weighted by their angle there. With these the sign of the
/// distance from a closed mesh is correct everywhere (Baerentzen and Aanaes 2005, "Signed distance
/// computation using the angle weighted pseudonormal"); a face's normal alone is wrong beside sharp
/// edges.
class PseudoNormals {
 public:
  /// Copies what it needs. Triangles must reference existing vertices.
  explicit PseudoNormals(const TriangleMesh& mesh);
  /// The same, for meshes of any size. Fails with kCancelled soon after the context is.
  static Result<PseudoNormals> create(const TriangleMesh& mesh, const RunContext& context);

  /// Unit normal at a point on a triangle, as MeshDistance::closest() finds it: of the vertex or
  /// edge of the triangle that contains the point (to within 1 nm), else of the face. Zero if the
  /// faces have no area.
  Vec3d at(const Vec3d& point, std::uint32_t triangle) const;

 private:
  PseudoNormals(const TriangleMesh& mesh, const RunContext& context);
  void set_edges(const RunContext& context);

  std::vector<Vec3f> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3f> of_face_, of_vertex_;
  std::vector<std::array<Vec3f, 3>> of_edge_;  // from corner c to corner c + 1
};

}  // namespace turnscan
