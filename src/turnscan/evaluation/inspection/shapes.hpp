#pragma once
// What a person measures on a mesh with a few clicks.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Radians, 0 to pi, between the ways from `corner` to a and to b; nullopt where one has no length.
std::optional<double> angle_at(const Vec3d& corner, const Vec3d& a, const Vec3d& b);

struct Circle {
  Vec3d center = Vec3d::Zero();
  Vec3d normal = Vec3d::UnitZ();  ///< unit length
  double radius_m = 0.0;
};
/// nullopt when the points lie on a line.
std::optional<Circle> circle_through(const Vec3d& a, const Vec3d& b, const Vec3d& c);

struct PlaneFit {
  Vec3d point = Vec3d::Zero(), normal = Vec3d::UnitZ();
  double flatness_m = 0.0;  ///< between the two parallel planes that hold all points
  double rms_m = 0.0;       ///< distance of the points to the plane
  std::size_t count = 0;
};
/// Least squares of the distances, through the centroid. The normal is not oriented. nullopt: fewer
/// than 3 points, or all on a line.
std::optional<PlaneFit> plane_through(std::span<const Vec3d> points);

struct SurfacePoint {
  Vec3d point = Vec3d::Zero();
  Vec3d normal = Vec3d::Zero();  ///< of the triangle, unit length
  std::uint32_t triangle = 0;
  Vec3d weights = Vec3d::Zero();  ///< of the triangle's corners; their sum is 1
  double distance_m = 0.0;        ///< from the place that was asked for
};
/// The point of the mesh nearest to a place. For single queries: looks at every triangle, where
/// MeshDistance would have to be built. nullopt: no triangle has an area.
std::optional<SurfacePoint> nearest_surface_point(const TriangleMesh& mesh, const Vec3d& place);

/// How much material lies behind a point of the surface, straight inward: the way to where the ray
/// leaves the mesh. nullopt: it does not, as the mesh has a hole there. Metres.
std::optional<double> wall_thickness(const TriangleMesh& mesh, const SurfacePoint& at);

}  // namespace turnscan
