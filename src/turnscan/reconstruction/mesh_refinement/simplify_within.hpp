#pragma once

#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan::mesh_refinement {

struct SimplifiedMesh {
  TriangleMesh mesh;
  /// For each vertex of the full mesh the nearest point on the simplified one.
  std::vector<MeshDistance::Hit> nearest;
};

/// Simplifies to as few triangles as the goal allows, with its error bound or a smaller one, such
/// that every vertex of the mesh stays within max_distance_m of the simplified surface, folds are
/// rare, and a watertight mesh stays watertight; returns the full mesh, without nearest points, if
/// no attempt succeeds. Fails as simplify() does, and with kCancelled.
Result<SimplifiedMesh> simplify_within(const TriangleMesh& full, const SimplifyGoal& goal,
                                       double max_distance_m, const RunContext& context);

}  // namespace turnscan::mesh_refinement
