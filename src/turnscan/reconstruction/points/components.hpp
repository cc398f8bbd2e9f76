#pragma once
// Objects as connected components of surviving voxels (thesis 6.1.3).

#include <turnscan/reconstruction/options/point_options.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::points {

struct Components {
  std::vector<std::int32_t> label;  ///< per voxel: object number from 0, largest first; -1: none
  std::vector<std::size_t> voxel_count;  ///< per object
  std::size_t crumbs = 0;                ///< pieces below the minimum size
  std::size_t not_kept = 0;              ///< pieces excluded by `keep`
  std::size_t joined = 0;                ///< floating pieces that were joined to another
};

/// reach 1: the 26-neighbourhood of voxels. A larger reach bridges the gaps of sparse scans: pieces
/// that are at most reach / 2 voxels apart are always joined, those more than reach apart never
/// (cells of reach / 2 voxels, 26-neighbourhood). Ordered by number of points, ties by position.
///
/// If the height of a floor is known (voxels below floor_m stand on it), a floating piece is joined
/// to what holds it (tsdf::attach_detached), but not across more than half of its own size: no
/// surface would bridge that.
Result<Components> find_components(const voxels::VoxelGrid& grid, const ComponentOptions& options,
                                   int reach, std::optional<double> floor_m = std::nullopt);

}  // namespace turnscan::points
