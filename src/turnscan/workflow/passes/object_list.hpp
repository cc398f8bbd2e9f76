#pragma once
// Objects that were reconstructed one by one, as one reconstruction of all.

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// The largest object of each, largest first, with the choices, passes and notes that belong to it.
/// At least one, and each with an object. Times and points are those of all together.
Reconstruction list_objects(std::vector<Reconstruction> made);

/// Adds the points, and of their attributes those that both have.
void append_cloud(const PointCloud& cloud, PointCloud& all);

}  // namespace turnscan
