#pragma once
// Mesh simplification.

#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

struct SimplifyGoal {
  std::size_t triangles = 0;  ///< target number, unless the error would be larger
  double max_error_m = 1e30;  ///< maximum distance as estimated by the quadrics
  /// One flag per triangle that is to stay unchanged; empty: none.
  std::vector<std::uint8_t> keep = {};
};

/// Collapses edges by quadric error (Garland and Heckbert 1997; meshoptimizer) until the goal is
/// met. Vertices keep their positions and attributes; triangles keep their order of vertices. A
/// watertight mesh stays watertight, which is checked: where edges fold together, the surface is
/// separated and the cuts are closed, and if that does not help it stops earlier, in the worst case
/// at the input. Other meshes keep their borders.
/// Fails with kFormat as validate_mesh does. Deterministic.
Result<TriangleMesh> simplify(const TriangleMesh& mesh, const SimplifyGoal& goal);

/// The same without the check: where edges fold together the result is not a manifold, and pieces
/// that shrink to nothing are lost.
Result<TriangleMesh> collapse_edges(const TriangleMesh& mesh, const SimplifyGoal& goal);

}  // namespace turnscan
