#pragma once
// Averaging of a depth camera over neighbouring pixels, estimated from its noise: the share of each
// neighbour along a row, 0 to 1/3; the pixel's own share is 1 minus twice this. 0 if neighbours are
// independent, or if there are too few data. Views of depth images; noise_m: of a depth value.

#include <optional>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// Estimates the share from differences between consecutive views with nearly the same viewpoint:
/// their noise has the filter's correlation. nullopt if too few views are that close, as with few
/// frames per turn, and if the differences are mostly rounding or show the rotation of the surface.
std::optional<double> share_of_neighbours(std::span<const views::DepthView> views, double noise_m);

/// Estimates the share from differences between views and the mesh reconstructed from them.
double share_of_neighbours(std::span<const views::DepthView> views, const TriangleMesh& mesh,
                           double noise_m);

}  // namespace turnscan::estimation
