#pragma once

#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::mesh_refinement {

/// As few triangles as keep every vertex of the mesh within max_error_m of the simplified surface,
/// and no fewer than `triangles`: the full mesh where no try stays within it. Fails as simplify()
/// does, and with kCancelled.
Result<TriangleMesh> simplify_within(const TriangleMesh& full, std::size_t triangles,
                                     double max_error_m, const RunContext& context);

}  // namespace turnscan::mesh_refinement
