#pragma once
// The steps of wrap().

#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan::grid {

/// Distances beyond this many cells past the offset are all the same to the wrap.
inline constexpr double kWrapBandCells = 2.0;
/// How near to the soup a wrap's vertices may come, so that the two sides of a sheet stay apart.
inline constexpr double kWrapStandOffCells = 0.02;

struct WrapMeasures {
  double cell_m, offset_m, band_m;
};

/// Distance to the soup minus the offset, known near the soup; negative wherever a flood from
/// outside does not reach without coming nearer than the offset. box: that of the soup.
Result<BrickGrid> wrap_field(const MeshDistance& soup, const Box& box, const WrapMeasures& measures,
                             std::size_t max_bytes, const RunContext& context);

/// Moves the vertices of the isosurface as far towards the soup as no triangle turns over.
Result<> pull_onto(const MeshDistance& soup, const WrapMeasures& measures, TriangleMesh& mesh,
                   const RunContext& context);

}  // namespace turnscan::grid
