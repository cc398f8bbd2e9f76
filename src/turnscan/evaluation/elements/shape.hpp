#pragma once
// The shapes that elements are: ideal surfaces, a circle and a line in a plane, a point.

#include <optional>
#include <string_view>
#include <turnscan/core/eigen.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::elements {

enum class Kind { kSphere, kCylinder, kCone, kPlane, kCircle, kLine, kPoint };

/// "sphere", "cylinder", ...
std::string_view name_of(Kind kind);

struct Shape {
  Kind kind = Kind::kPlane;
  /// Centre of a sphere or circle, apex of a cone; any point of a plane, axis or line.
  Vec3d point = Vec3d::Zero();
  /// Unit length: the normal of a plane or circle, an axis, the direction of a line. From its apex,
  /// a cone is on this side.
  Vec3d direction = Vec3d::UnitZ();
  double radius_m = 0.0;        ///< of sphere, cylinder, circle
  double half_angle_rad = 0.0;  ///< of a cone, between its axis and its surface
  /// Unit length: of the plane in which the points of a circle or line are taken.
  Vec3d section_normal = Vec3d::UnitZ();
};

bool is_section(Kind kind);     ///< circle, line
bool has_direction(Kind kind);  ///< not sphere, point
bool is_axis(Kind kind);        ///< line, cylinder, cone: as far as relations are concerned
bool has_radius(Kind kind);     ///< sphere, cylinder, circle

/// Changes of a shape: of point (3), direction (3), radius and half angle.
using Change = Eigen::Matrix<double, 8, 1>;
/// Six changes as columns, of which those that the shape does not have are zero.
using Changes = Eigen::Matrix<double, 8, 6>;

/// Signed distance of a point from the shape; from a circle or line within its plane.
double distance(const Shape& shape, const Vec3d& p);
/// Derivatives of the distance by what a Change changes. Minus its first three are the normal at p.
Change gradient(const Shape& shape, const Vec3d& p);

/// The independent changes of a shape, in metres: turns are those of an arm of this length.
Changes freedoms(const Shape& shape, double arm_m);
int freedoms_of(Kind kind);
Shape changed(Shape shape, const Change& change);

/// The shape with that of its points as `point` which is nearest to `place`, if it may be any.
Shape moved_along(Shape shape, const Vec3d& place);
Shape transformed(Shape shape, const Pose& pose);

/// The line of two planes, or the point of a plane and an axis; nullopt if they are parallel, or
/// are other shapes.
std::optional<Shape> intersection(const Shape& a, const Shape& b);
/// Distance of the point of one from the other, which is the plane, or else the axis, if there is
/// one. Metres.
double distance_between(const Shape& a, const Shape& b);
/// Angle between two directions, of planes to their normals' complement; 0 to a quarter turn.
double angle_between(const Shape& a, const Shape& b);

}  // namespace turnscan::elements
