#pragma once
// Combines objects that were reconstructed one by one into one reconstruction.

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// Takes the largest object of each reconstruction, largest first, with its choices, passes and
/// notes. Needs at least one reconstruction, and each with an object. Times and points are totals.
Reconstruction list_objects(std::vector<Reconstruction> made);

/// Appends the points, and those attributes that both clouds have.
void append_cloud(const PointCloud& cloud, PointCloud& all);

}  // namespace turnscan
