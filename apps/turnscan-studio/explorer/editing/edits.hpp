#pragma once
// Operations on parts of clouds. Nothing here touches a widget.

#include <functional>
#include <turnscan/core/point_cloud.hpp>

#include "explorer/models.hpp"

namespace turnscan::studio {

/// The points for which keep(i) is true, with all their attributes.
PointCloud points_where(const PointCloud& cloud, const std::function<bool(std::size_t)>& keep);
/// The part where normal . p >= offset.
PointCloud cut(const PointCloud& cloud, const Vec3d& normal, double offset);
/// Number of triangles of a mesh, or of points of a cloud.
std::size_t parts_of(const ModelData& data);
/// Highlight of the selected part over the model; nullptr if nothing is selected.
DrawablePtr selection_drawable(const ModelData& data, const Selection& selection);

}  // namespace turnscan::studio
