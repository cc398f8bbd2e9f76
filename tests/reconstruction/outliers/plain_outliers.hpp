#pragma once
// The statistical outlier filter by its definition, as an oracle: all distances of each point, and
// sums in the order and precision of pcl::StatisticalOutlierRemoval (1.13). For some 10,000 points.
// bench/outliers_bench holds the filter against PCL itself.

#include <cstdint>
#include <span>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::testing {

/// Per point 1 to keep, 0 to drop.
std::vector<std::uint8_t> plain_outlier_mask(std::span<const Vec3f> points, int k, double lambda);

}  // namespace turnscan::testing
