#pragma once
// Cuts of meshes and clouds. Nothing here touches a widget.

#include <functional>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <utility>
#include <vector>

namespace turnscan::studio {

/// The part where normal . p >= offset. Triangles on the plane are cut along it; the cut stays
/// open. Normals and colours of new vertices are blended.
TriangleMesh cut(const TriangleMesh& mesh, const Vec3d& normal, double offset);

/// The points for which keep(i) holds, with all their attributes.
PointCloud points_where(const PointCloud& cloud, const std::function<bool(std::size_t)>& keep);
PointCloud cut(const PointCloud& cloud, const Vec3d& normal, double offset);

/// A closed outline on the screen, in pixels.
using Outline = std::vector<std::pair<double, double>>;
/// Whether a place is inside, by the parity of crossings.
bool inside(const Outline& outline, double x, double y);

/// Without what is seen inside the outline, also behind other parts: points, and triangles with
/// all corners inside. to_pixels: see SceneView::to_pixels().
TriangleMesh without_lassoed(const TriangleMesh& mesh, const Outline& outline,
                             const Eigen::Matrix4d& to_pixels);
PointCloud without_lassoed(const PointCloud& cloud, const Outline& outline,
                           const Eigen::Matrix4d& to_pixels);

}  // namespace turnscan::studio
