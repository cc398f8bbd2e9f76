#pragma once

#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>

namespace turnscan::mesh_refinement {

/// As few triangles as keep every vertex of the mesh within max_distance_m of the simplified
/// surface, fold little, and as the goal allows, whose error is smaller or the same: the full mesh
/// where no try does so. Fails as simplify() does, and with kCancelled.
Result<TriangleMesh> simplify_within(const TriangleMesh& full, const SimplifyGoal& goal,
                                     double max_distance_m, const RunContext& context);

}  // namespace turnscan::mesh_refinement
