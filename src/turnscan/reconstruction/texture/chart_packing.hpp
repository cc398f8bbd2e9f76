#pragma once
// Packs chart outlines into a square.

#include <cstdint>
#include <optional>
#include <vector>

namespace turnscan::texture {

/// A chart on a grid of squares: the rows [bottom, top) that it occupies in each of its columns.
struct ChartOutline {
  int width = 0, height = 0;
  std::vector<std::int32_t> bottom, top;  ///< per column
};

struct ChartPlace {
  int column = 0, row = 0;
};

/// Positions of all charts in a square of side x side; nullopt if they do not fit. Places the
/// tallest first, each where the skyline of the previous ones is lowest.
std::optional<std::vector<ChartPlace>> pack_charts(const std::vector<ChartOutline>& charts,
                                                   int side);

}  // namespace turnscan::texture
