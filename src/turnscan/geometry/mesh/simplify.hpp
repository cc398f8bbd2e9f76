#pragma once
// Fewer triangles for the same shape.

#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

struct SimplifyGoal {
  std::size_t triangles = 0;  ///< as few as this, unless the error would be larger
  double max_error_m = 1e30;  ///< largest distance that the quadrics estimate
  bool one_solid = false;     ///< it is known to be one watertight piece: not looked at again
  /// One flag per triangle, those that stay as they are; empty: none of them.
  std::vector<std::uint8_t> keep = {};
};

/// Collapses edges by quadric error (Garland and Heckbert 1997; meshoptimizer) until the goal is
/// met. Vertices stay where they are, with their attributes; triangles keep their order of
/// vertices. A watertight mesh stays watertight, which is checked: where edges fold together,
/// the surface is parted and the cuts are closed, and if that does not help it ends sooner, at
/// worst where it began. Other meshes keep their borders.
/// Fails with kFormat as validate_mesh does. Deterministic.
Result<TriangleMesh> simplify(const TriangleMesh& mesh, const SimplifyGoal& goal);

}  // namespace turnscan
