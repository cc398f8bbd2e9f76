#include <turnscan/evaluation/plane_outline.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace turnscan::artefact {

namespace {

using Point2 = Eigen::Vector2d;

/// Convex hull, counter-clockwise (Andrew 1979).
std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  const auto turns_right = [](const Point2& a, const Point2& b, const Point2& c) {
    const Point2 u = b - a, v = c - a;
    return u.x() * v.y() - u.y() * v.x() <= 0.0;
  };
  std::vector<Point2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= first + 2 && turns_right(hull[hull.size() - 2], hull.back(), p))
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // it is the start of the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Coordinates in a plane.
struct PlaneAxes {
  explicit PlaneAxes(const Plane& plane)
      : origin(plane.point), x(plane.unit.unitOrthogonal()), y(plane.unit.cross(x)) {}
  Point2 of(const Vec3d& p) const { return {x.dot(p - origin), y.dot(p - origin)}; }

  Vec3d origin, x, y;
};

/// Longer side first. One side of the smallest rectangle contains one of the hull's.
std::pair<double, double> size_of(const std::vector<Point2>& hull) {
  std::pair<double, double> best{0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    Eigen::AlignedBox2d box;
    for (const Point2& p : hull)
      box.extend(Point2(along.dot(p), along.x() * p.y() - along.y() * p.x()));
    const Point2 size = box.sizes();
    if (size.prod() >= least) continue;
    least = size.prod();
    best = {size.maxCoeff(), size.minCoeff()};
  }
  return best;
}

std::vector<Point2> in_plane(const std::vector<Vec3d>& points, const Plane& plane) {
  const PlaneAxes axes(plane);
  std::vector<Point2> flat;
  flat.reserve(points.size());
  for (const Vec3d& p : points) flat.push_back(axes.of(p));
  return flat;
}

}  // namespace

std::vector<Vec3d> within_margin(const std::vector<Vec3d>& points, const Plane& plane,
                                 double margin_m) {
  const std::vector<Point2> flat = in_plane(points, plane);
  const std::vector<Point2> hull = convex_hull(flat);
  std::vector<Vec3d> inner;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t h = 0; h < hull.size(); ++h) {
      const Point2 along = (hull[(h + 1) % hull.size()] - hull[h]).normalized();
      const Point2 to = flat[i] - hull[h];
      nearest = std::min(nearest, along.x() * to.y() - along.y() * to.x());
    }
    if (nearest >= margin_m) inner.push_back(points[i]);
  }
  return inner;
}

std::pair<double, double> outline_size(const std::vector<Vec3d>& points, const Plane& plane) {
  return size_of(convex_hull(in_plane(points, plane)));
}

}  // namespace turnscan::artefact
