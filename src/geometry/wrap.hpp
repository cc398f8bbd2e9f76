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
  double offset_cells = 1.0;     ///< the wrap is first laid this far around the triangles
  bool project = true;           ///< then pull its vertices back onto them
  std::size_t max_bytes = std::size_t(4) << 30;  ///< of grid memory
};
/// Fields wrap-cell, wrap-offset and wrap-project.
OptionTable describe(WrapOptions& options);

/// What stands around a soup of triangles (open, self-crossing, with edges of many triangles, of
/// any orientation), as a closed 2-manifold outward mesh by construction: distances to the soup on
/// a grid, flood fill from outside, the surface at offset_cells around it, vertices pulled back
/// onto the soup where no triangle turns over. Gaps narrower than about offset_cells * 2 are
/// bridged, and so is what is behind them filled; an open sheet becomes a thin closed plate.
/// Vertices pulled back stop 1 % of a cell before the soup, so that both sides of a sheet stay
/// apart. Colours are those of the soup's nearest points. Fails with kFormat (validate_mesh),
/// kTooFewPoints (no triangle), kInvalidOption, kResourceLimit, kCancelled.
Result<TriangleMesh> wrap(const TriangleMesh& mesh, const WrapOptions& options,
                          const RunContext& context);

}  // namespace turnscan
