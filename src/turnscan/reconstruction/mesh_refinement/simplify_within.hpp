#pragma once

#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>

namespace turnscan::mesh_refinement {

/// Simplifies to as few triangles as the goal allows, with its error bound or a smaller one, such
/// that every vertex of the mesh stays within max_distance_m of the simplified surface and folds
/// are rare; returns the full mesh if no attempt succeeds. Fails as simplify() does, and with
/// kCancelled.
Result<TriangleMesh> simplify_within(const TriangleMesh& full, const SimplifyGoal& goal,
                                     double max_distance_m, const RunContext& context);

}  // namespace turnscan::mesh_refinement
