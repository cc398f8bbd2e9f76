#pragma once
// Parts of clouds. Nothing here touches a widget.

#include <functional>
#include <turnscan/core/point_cloud.hpp>

#include "explorer/models.hpp"

namespace turnscan::studio {

/// The points for which keep(i) holds, with all their attributes.
PointCloud points_where(const PointCloud& cloud, const std::function<bool(std::size_t)>& keep);
/// The part where normal . p >= offset.
PointCloud cut(const PointCloud& cloud, const Vec3d& normal, double offset);
/// Triangles of a mesh, or points of a cloud.
std::size_t parts_of(const ModelData& data);
/// How a selected part is shown over the model; nullptr where nothing is selected.
DrawablePtr selection_drawable(const ModelData& data, const Selection& selection);

}  // namespace turnscan::studio
