#pragma once
// Statistical outlier filter (Rusu et al. 2008, "Towards 3D point cloud based object maps for
// household environments", section 4.1; thesis 3.3): points whose neighbours are far are noise.

#include <cstdint>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options/outlier_options.hpp>
#include <vector>

namespace turnscan::outliers {

/// What the filter saw. With fewer than two points sd and threshold are NaN, as when it is off.
struct OutlierStatistics {
  double mean_m = 0.0;       ///< mean of d_i
  double sd_m = 0.0;         ///< their standard deviation (n - 1); NaN where rounding makes the
                             ///< variance of equal distances negative
  double threshold_m = 0.0;  ///< mean + lambda * sd
};

/// Per point 1 to keep, 0 to drop. d_i is the mean distance of point i to its k nearest neighbours,
/// itself left out (other points at the same place count); kept are the points with
/// d_i <= mean + lambda * sd over the frame, and all of them where the threshold is NaN. With n <=
/// k points the sum over the n - 1 others is still divided by k. These are exactly the points that
/// pcl::StatisticalOutlierRemoval (1.13) keeps of the same cloud, unorganised; see
/// docs/stages/outliers.md for the proof and for the one reservation.
///
/// Frames with cells are searched in their grid: many times faster than a tree, on one thread, in
/// buffers that the thread keeps (call it for many frames in parallel). Others, those with k > 128
/// and the rare grids that tell nothing about space are searched in a tree.
///
/// All ones when options.enabled is false. Fails with kInvalidOption when an option is out of
/// range, kFormat when a coordinate is not finite or beyond 1e9 m. Throws std::invalid_argument
/// when cells are there but do not fit the points or the grid.
Result<std::vector<std::uint8_t>> statistical_outlier_mask(const FramePoints& frame,
                                                           const OutlierOptions& options,
                                                           OutlierStatistics* statistics = nullptr);

/// The same for points without a grid, on all cores. Also fails with kCancelled.
Result<std::vector<std::uint8_t>> statistical_outlier_mask(std::span<const Vec3f> points,
                                                           const OutlierOptions& options,
                                                           const RunContext& context = {},
                                                           OutlierStatistics* statistics = nullptr);

}  // namespace turnscan::outliers
