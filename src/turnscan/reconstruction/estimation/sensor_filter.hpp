#pragma once
// How much a depth camera averages over neighbouring pixels, estimated from its noise.

#include <span>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// The share of each neighbour along a row, 0 to 1/3: of a pixel's depth 1 - 2 times this is its
/// own. From differences between consecutive views from nearly the same place: their noise has the
/// filter's correlation. Where no views are that near, from third differences along the rows of
/// each. 0 where neighbours are independent, or where too little tells.
/// Views of depth images, noise_m of a depth.
double share_of_neighbours(std::span<const views::DepthView> views, double noise_m);

}  // namespace turnscan::estimation
