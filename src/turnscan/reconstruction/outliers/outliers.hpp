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

/// Per point 1 to keep, 0 to drop. d_i is the mean distance of point i to its k nearest neighbours,
/// itself left out (other points at the same place count); kept are the points with
/// d_i <= mean + lambda * sd over all points, and all of them where the threshold is NaN (fewer
/// than two points, or rounding that makes the variance of equal distances negative). With n <= k
/// points the sum over the n - 1 others is still divided by k. These are exactly the points that
/// pcl::StatisticalOutlierRemoval (1.13) keeps of the same cloud, unorganised; see
/// docs/reference/stages/outliers.md for the one reservation. Runs on all cores.
///
/// All ones when options.enabled is false. Fails with kInvalidOption when an option is out of
/// range, kFormat when a coordinate is not finite or beyond 1e9 m, and kCancelled.
Result<std::vector<std::uint8_t>> statistical_outlier_mask(std::span<const Vec3f> points,
                                                           const OutlierOptions& options,
                                                           const RunContext& context = {});

}  // namespace turnscan::outliers
