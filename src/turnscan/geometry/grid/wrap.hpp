#pragma once
// A closed surface around any triangles.

#include <optional>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct WrapOptions {
  std::optional<double> cell_m;  ///< auto: the longest side of the bounding box / 200
  double offset_cells = 1.0;     ///< how far around the triangles the wrap is laid first
  bool project = true;           ///< then pull its vertices back onto them
  std::size_t max_bytes = std::size_t(4) << 30;  ///< of grid memory
};
/// Fields wrap-cell, wrap-offset and wrap-project.
OptionTable describe(WrapOptions& options);

/// What stands around a soup of triangles (open, self-crossing, with edges of many triangles, of
/// any orientation), as a closed 2-manifold outward mesh by construction: distances to the soup on
/// a grid, flood fill from outside, the isosurface at offset_cells around it, vertices pulled back
/// onto the soup where no triangle turns over. Gaps narrower than about 2 * offset_cells are
/// bridged, and what is enclosed behind them is filled; cavities without an opening are filled,
/// too. An open sheet becomes a thin closed plate: vertices pulled back stop 2 % of a cell before
/// the soup, so that its two sides stay apart. Parts that lie farther apart stay separate pieces.
/// Colours are those of the soup's nearest points; normals are not kept.
/// Begins the phases "measure distances", "wrap". Fails with kFormat (validate_mesh),
/// kTooFewPoints (no triangle), kInvalidOption, kResourceLimit (cells too small for max_bytes),
/// kCancelled. The same bytes for any number of threads.
Result<TriangleMesh> wrap(const TriangleMesh& mesh, const WrapOptions& options,
                          const RunContext& context);

}  // namespace turnscan
