#pragma once
// A closed surface around any triangles.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::grid {

/// What stands around a soup of triangles (open, self-crossing, with edges of many triangles, of
/// any orientation), as a closed 2-manifold outward mesh by construction: distances to the soup on
/// a grid of cells of cell_m, flood fill from outside, the isosurface one cell around it, vertices
/// pulled back onto the soup where no triangle turns over. Gaps narrower than about two cells are
/// bridged, and what is enclosed behind them is filled; cavities without an opening are filled,
/// too. An open sheet becomes a thin closed plate: vertices pulled back stop 2 % of a cell before
/// the soup, so that its two sides stay apart. Parts that lie farther apart stay separate pieces.
/// Colours and normals are not kept.
/// Begins the phases "measure distances", "wrap". Fails with kFormat (validate_mesh),
/// kTooFewPoints (no triangle), kInvalidOption (cell_m not positive), kResourceLimit (cells too
/// small for 4 GB), kCancelled. The same bytes for any number of threads.
Result<TriangleMesh> wrap(const TriangleMesh& mesh, double cell_m, const RunContext& context);

}  // namespace turnscan::grid
