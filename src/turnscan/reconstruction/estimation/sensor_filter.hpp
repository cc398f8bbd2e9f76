#pragma once
// How much a depth camera averages over neighbouring pixels, estimated from its noise: the share of
// each neighbour along a row, 0 to 1/3. Of a pixel's depth 1 - 2 times this is its own. 0 where
// neighbours are independent, or where too little tells. Views of depth images; noise_m: of a
// depth.

#include <optional>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// From differences between consecutive views from nearly the same place: their noise has the
/// filter's correlation. nullopt where too few views are that near, as with few frames a turn,
/// and where the differences are mostly rounding or show how the surface turned.
std::optional<double> share_of_neighbours(std::span<const views::DepthView> views, double noise_m);

/// From differences between views and the mesh that they make.
double share_of_neighbours(std::span<const views::DepthView> views, const TriangleMesh& mesh,
                           double noise_m);

/// Standard deviation of depths behind the filter, of independent ones of deviation 1 before it: 1,
/// down to 1/3 where three by three pixels are averaged.
double noise_left_by_filter(double share);

}  // namespace turnscan::estimation
