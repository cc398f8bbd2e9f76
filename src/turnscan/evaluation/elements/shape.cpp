#include <turnscan/evaluation/elements/shape.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace turnscan::elements {

namespace {

/// p relative to an axis: the distance along it, and across it with its direction.
struct Cylindrical {
  double along = 0.0, across = 0.0;
  Vec3d outward = Vec3d::Zero();
};

Cylindrical cylindrical(const Shape& s, const Vec3d& p) {
  const Vec3d v = p - s.point;
  const double along = s.direction.dot(v);
  const Vec3d across = v - along * s.direction;
  return {along, across.norm(), across.normalized()};
}

/// Of a line, within its plane.
Vec3d side_of(const Shape& line) { return line.section_normal.cross(line.direction); }

Vec3d nearest_on(const Shape& s, const Vec3d& p) {
  const Vec3d v = p - s.point;
  if (s.kind == Kind::kPlane) return p - s.direction.dot(v) * s.direction;
  return is_axis(s.kind) ? Vec3d(s.point + s.direction.dot(v) * s.direction) : s.point;
}

Shape line_of(const Shape& a, const Shape& b) {
  const Vec3d across = a.direction.cross(b.direction);
  // The point of both planes that is nearest to a's.
  const Vec3d down = across.cross(a.direction);
  const double t = b.direction.dot(b.point - a.point) / b.direction.dot(down);
  Shape line;
  line.kind = Kind::kLine;
  line.point = a.point + t * down;
  line.direction = across.normalized();
  return line;
}

}  // namespace

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 7> kNames{"sphere", "cylinder", "cone", "plane",
                                                   "circle", "line",     "point"};
  return kNames[static_cast<std::size_t>(kind)];
}

bool is_section(Kind kind) { return kind == Kind::kCircle || kind == Kind::kLine; }
bool has_direction(Kind kind) { return kind != Kind::kSphere && kind != Kind::kPoint; }
bool is_axis(Kind kind) {
  return kind == Kind::kLine || kind == Kind::kCylinder || kind == Kind::kCone;
}
bool has_radius(Kind kind) {
  return kind == Kind::kSphere || kind == Kind::kCylinder || kind == Kind::kCircle;
}

double distance(const Shape& s, const Vec3d& p) {
  switch (s.kind) {
    case Kind::kPlane:
      return s.direction.dot(p - s.point);
    case Kind::kLine:
      return side_of(s).dot(p - s.point);
    case Kind::kCylinder:
    case Kind::kCircle:
      return cylindrical(s, p).across - s.radius_m;
    case Kind::kCone: {
      const Cylindrical c = cylindrical(s, p);
      return c.across * std::cos(s.half_angle_rad) - c.along * std::sin(s.half_angle_rad);
    }
    case Kind::kSphere:
    case Kind::kPoint:
      break;
  }
  return (p - s.point).norm() - s.radius_m;
}

Change gradient(const Shape& s, const Vec3d& p) {
  const Vec3d v = p - s.point;
  Change out = Change::Zero();
  switch (s.kind) {
    case Kind::kPlane:
      out << -s.direction, v, 0.0, 0.0;
      return out;
    case Kind::kLine:
      out << -side_of(s), v.cross(s.section_normal), 0.0, 0.0;
      return out;
    case Kind::kCylinder:
    case Kind::kCircle: {
      const Cylindrical c = cylindrical(s, p);
      out << -c.outward, -c.along * c.outward, -1.0, 0.0;
      return out;
    }
    case Kind::kCone: {
      const Cylindrical c = cylindrical(s, p);
      const double cosine = std::cos(s.half_angle_rad), sine = std::sin(s.half_angle_rad);
      out << sine * s.direction - cosine * c.outward, -cosine * c.along * c.outward - sine * v, 0.0,
          -sine * c.across - cosine * c.along;
      return out;
    }
    case Kind::kSphere:
    case Kind::kPoint:
      break;
  }
  out << -v.normalized(), Vec3d::Zero(), -1.0, 0.0;
  return out;
}

int freedoms_of(Kind kind) {
  constexpr std::array<int, 7> kCounts{4, 5, 6, 3, 3, 2, 3};
  return kCounts[static_cast<std::size_t>(kind)];
}

Changes freedoms(const Shape& s, double arm_m) {
  Changes out = Changes::Zero();
  int column = 0;
  const auto shift = [&](const Vec3d& along) { out.col(column++).head<3>() = along; };
  const auto turn = [&](const Vec3d& to) { out.col(column++).segment<3>(3) = to / arm_m; };
  const Vec3d a = s.direction.unitOrthogonal(), b = s.direction.cross(a);
  const bool whole = s.kind == Kind::kSphere || s.kind == Kind::kCone || s.kind == Kind::kPoint;
  if (s.kind == Kind::kLine) {
    shift(side_of(s));
    turn(side_of(s));
  } else if (s.kind == Kind::kPlane) {
    shift(s.direction);
  } else {
    shift(a);
    shift(b);
    if (whole) shift(s.direction);
  }
  if (s.kind == Kind::kPlane || s.kind == Kind::kCylinder || s.kind == Kind::kCone) {
    turn(a);
    turn(b);
  }
  if (has_radius(s.kind)) out.col(column++)[6] = 1.0;
  if (s.kind == Kind::kCone) out.col(column++)[7] = 1.0 / arm_m;
  return out;
}

Shape changed(Shape s, const Change& change) {
  s.point += change.head<3>();
  s.direction = (s.direction + change.segment<3>(3)).normalized();
  s.radius_m += change[6];
  s.half_angle_rad += change[7];
  return s;
}

Shape moved_along(Shape s, const Vec3d& place) {
  if (s.kind != Kind::kCone) s.point = nearest_on(s, place);
  return s;
}

Shape transformed(Shape s, const Pose& pose) {
  s.point = pose * s.point;
  s.direction = pose.linear() * s.direction;
  s.section_normal = pose.linear() * s.section_normal;
  return s;
}

std::optional<Shape> intersection(const Shape& a, const Shape& b) {
  if (a.kind != Kind::kPlane) {
    if (b.kind != Kind::kPlane) return std::nullopt;
    return intersection(b, a);
  }
  constexpr double kParallel = 1e-9;  // a sine, far beyond what any scan tells apart
  if (b.kind == Kind::kPlane) {
    if (!(a.direction.cross(b.direction).norm() > kParallel)) return std::nullopt;
    return line_of(a, b);
  }
  const double towards = a.direction.dot(b.direction);
  if (!is_axis(b.kind) || !(std::abs(towards) > kParallel)) return std::nullopt;
  Shape point;
  point.kind = Kind::kPoint;
  point.point = b.point + a.direction.dot(a.point - b.point) / towards * b.direction;
  return point;
}

double distance_between(const Shape& a, const Shape& b) {
  const auto rank = [](Kind kind) { return kind == Kind::kPlane ? 2 : is_axis(kind) ? 1 : 0; };
  const bool swap = rank(a.kind) > rank(b.kind);
  const Shape &from = swap ? b : a, &to = swap ? a : b;
  return (nearest_on(to, from.point) - from.point).norm();
}

double angle_between(const Shape& a, const Shape& b) {
  // A plane's angle to an axis is that of the plane, not of its normal.
  const bool complement = (a.kind == Kind::kPlane) != (b.kind == Kind::kPlane);
  const double angle =
      std::atan2(a.direction.cross(b.direction).norm(), std::abs(a.direction.dot(b.direction)));
  return complement ? std::numbers::pi / 2 - angle : angle;
}

}  // namespace turnscan::elements
