#pragma once
// Mean distances to the nearest neighbours of points without a grid.

#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::outliers {

/// Mean distance of each point to its k nearest others, on all cores; the same bytes for any number
/// of threads and every instruction set. Points are finite and more than k; k <= kMaxK. Works on
/// the points of a balanced tree's leaf side by side, with one walk through the tree for all of
/// them. Fails with kCancelled.
Result<> tree_mean_distances(std::span<const Vec3f> points, int k, const RunContext& context,
                             std::span<float> mean);

}  // namespace turnscan::outliers
