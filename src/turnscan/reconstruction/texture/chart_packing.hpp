#pragma once
// Outlines packed into a square.

#include <cstdint>
#include <optional>
#include <vector>

namespace turnscan::texture {

/// A chart on a grid of squares: in each of its columns the rows [bottom, top) that it needs.
struct ChartOutline {
  int width = 0, height = 0;
  std::vector<std::int32_t> bottom, top;  ///< per column
};

struct ChartPlace {
  int column = 0, row = 0;
};

/// Places for all charts in a square of side x side; nothing where they do not fit. The tallest
/// first, each where the ground that those before it leave is lowest.
std::optional<std::vector<ChartPlace>> pack_charts(const std::vector<ChartOutline>& charts,
                                                   int side);

}  // namespace turnscan::texture
