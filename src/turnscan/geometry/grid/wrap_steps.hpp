#pragma once
// The steps of wrap().

#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan::grid {

/// Distance to the mesh minus one cell, known near the mesh; negative wherever a flood from outside
/// does not reach without coming nearer than a cell. soup: the mesh's distances.
Result<BrickGrid> wrap_field(const MeshDistance& soup, const TriangleMesh& mesh, double cell_m,
                             const RunContext& context);

/// Moves the vertices of the isosurface as far towards the soup as no triangle turns over.
Result<> pull_onto(const MeshDistance& soup, double cell_m, TriangleMesh& mesh,
                   const RunContext& context);

}  // namespace turnscan::grid
