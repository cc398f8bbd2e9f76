#pragma once
// Parts of clouds. Nothing here touches a widget.

#include <functional>
#include <turnscan/core/point_cloud.hpp>

namespace turnscan::studio {

/// The points for which keep(i) holds, with all their attributes.
PointCloud points_where(const PointCloud& cloud, const std::function<bool(std::size_t)>& keep);
/// The part where normal . p >= offset.
PointCloud cut(const PointCloud& cloud, const Vec3d& normal, double offset);

}  // namespace turnscan::studio
