#pragma once
// Geometric elements measured from a few picked points of a mesh.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Angle, 0 to pi, between the directions from `corner` to a and to b; nullopt if one has zero
/// length.
std::optional<double> angle_at(const Vec3d& corner, const Vec3d& a, const Vec3d& b);

struct Circle {
  Vec3d center = Vec3d::Zero();
  Vec3d normal = Vec3d::UnitZ();  ///< unit length
  double radius_m = 0.0;
};
/// nullopt if the points are collinear.
std::optional<Circle> circle_through(const Vec3d& a, const Vec3d& b, const Vec3d& c);

struct PlaneFit {
  Vec3d point = Vec3d::Zero(), normal = Vec3d::UnitZ();
  double flatness_m = 0.0;  ///< distance between the two parallel planes that enclose all points
  double rms_m = 0.0;       ///< of the points' distances to the plane
  std::size_t count = 0;
};
/// Least squares of the distances, through the centroid. The normal's sign is arbitrary. nullopt:
/// fewer than 3 points, or all collinear.
std::optional<PlaneFit> plane_through(std::span<const Vec3d> points);

struct SurfacePoint {
  Vec3d point = Vec3d::Zero();
  Vec3d normal = Vec3d::Zero();  ///< of the triangle, unit length
  std::uint32_t triangle = 0;
  Vec3d weights = Vec3d::Zero();  ///< barycentric coordinates; their sum is 1
  double distance_m = 0.0;        ///< from the query point
};
/// The point of the mesh nearest to a place. For single queries: visits every triangle, whereas
/// MeshDistance would have to be built first. nullopt: no triangle has an area.
std::optional<SurfacePoint> nearest_surface_point(const TriangleMesh& mesh, const Vec3d& place);

/// Thickness of the material behind a point of the surface, along its inward normal: the distance
/// to where the ray leaves the mesh. nullopt if it does not, because the mesh has a hole there.
/// Metres.
std::optional<double> wall_thickness(const TriangleMesh& mesh, const SurfacePoint& at);

}  // namespace turnscan
