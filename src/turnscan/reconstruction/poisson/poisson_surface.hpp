#pragma once
// Extracts the surface of a solved indicator.

#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/poisson/poisson_levels.hpp>

namespace turnscan::poisson {

/// The surface on which the finest level's indicator is iso, marched on cells of level `depth`,
/// which is the finest one or the next; vertices are moved onto the function itself, which is not
/// linear in a cell. Closed, 2-manifold and outward. Fails with kResourceLimit, kCancelled.
Result<TriangleMesh> indicator_surface(const OctreeLevels& levels, const Cube& cube, int depth,
                                       double iso, const RunContext& context);

}  // namespace turnscan::poisson
