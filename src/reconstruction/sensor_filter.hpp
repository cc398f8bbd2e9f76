#pragma once
// How much a depth camera averages over neighbouring pixels, told from its noise. Internal to the
// volumetric method.

#include <span>
#include <turnscan/reconstruction/depth_view.hpp>

namespace turnscan {

/// The share of each neighbour along a row, 0 to 1/3: of a pixel's depth 1 - 2 times this is its
/// own. From differences between consecutive views that look alike: their noise has the filter's
/// correlation. 0 where neighbours are independent, or where too few views look alike to tell.
/// Views of depth images, noise_m of a depth.
double share_of_neighbours(std::span<const DepthView> views, double noise_m);

}  // namespace turnscan
