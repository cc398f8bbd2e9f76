#include <turnscan/evaluation/inspection/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {

namespace {

std::array<Vec3d, 3> corners_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
          mesh.vertices[c].cast<double>()};
}

Vec3d barycentric(const std::array<Vec3d, 3>& t, const Vec3d& p) {
  const Vec3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = n.squaredNorm();
  const double b = n.dot((p - t[0]).cross(t[2] - t[0])) / area;
  const double c = n.dot((t[1] - t[0]).cross(p - t[0])) / area;
  return {1.0 - b - c, b, c};
}

}  // namespace

std::optional<double> angle_at(const Vec3d& corner, const Vec3d& a, const Vec3d& b) {
  const Vec3d u = a - corner, v = b - corner;
  if (!(u.norm() > 0.0) || !(v.norm() > 0.0)) return std::nullopt;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

std::optional<Circle> circle_through(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d u = b - a, v = c - a, n = u.cross(v);
  if (!(n.norm() > 1e-9 * u.norm() * v.norm())) return std::nullopt;
  const Vec3d to_center =
      (v.squaredNorm() * n.cross(u) - u.squaredNorm() * n.cross(v)) / (2.0 * n.squaredNorm());
  return Circle{a + to_center, n.normalized(), to_center.norm()};
}

std::optional<PlaneFit> plane_through(std::span<const Vec3d> points) {
  if (points.size() < 3) return std::nullopt;
  PlaneFit fit;
  fit.count = points.size();
  for (const Vec3d& p : points) fit.point += p / double(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3d& p : points) spread += (p - fit.point) * (p - fit.point).transpose();
  const auto eigen = estimation::symmetric_eigen(spread);
  if (!(eigen.values[1] > 1e-12 * eigen.values[2])) return std::nullopt;
  fit.normal = eigen.vectors.col(0);
  double low = 0.0, high = 0.0, squares = 0.0;
  for (const Vec3d& p : points) {
    const double away = fit.normal.dot(p - fit.point);
    low = std::min(low, away);
    high = std::max(high, away);
    squares += away * away;
  }
  fit.flatness_m = high - low;
  fit.rms_m = std::sqrt(squares / double(points.size()));
  return fit;
}

std::optional<SurfacePoint> nearest_surface_point(const TriangleMesh& mesh, const Vec3d& place) {
  std::optional<SurfacePoint> best;
  double reach = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = corners_of(mesh, t);
    const Vec3d low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    if (!((place - place.cwiseMax(low).cwiseMin(high)).norm() < reach)) continue;
    const Vec3d n = (c[1] - c[0]).cross(c[2] - c[0]);
    if (!(n.squaredNorm() > 0.0)) continue;
    const Vec3d p = closest_point_on_triangle(place, c[0], c[1], c[2]);
    const double distance = (p - place).norm();
    if (!(distance < reach)) continue;
    reach = distance;
    best =
        SurfacePoint{p, n.normalized(), static_cast<std::uint32_t>(t), barycentric(c, p), distance};
  }
  return best;
}

std::optional<double> wall_thickness(const TriangleMesh& mesh, const SurfacePoint& at) {
  constexpr double kEdge = 1e-9;  // a ray through an edge meets both of its triangles
  const Vec3d way = -at.normal;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = corners_of(mesh, t);
    const Vec3d n = (c[1] - c[0]).cross(c[2] - c[0]);
    const double toward = n.dot(way);
    if (!(toward > 0.0)) continue;  // the ray enters there, or is parallel
    const double s = n.dot(c[0] - at.point) / toward;
    if (!(s > 0.0) || s >= nearest) continue;
    if ((barycentric(c, at.point + s * way).array() >= -kEdge).all()) nearest = s;
  }
  if (!std::isfinite(nearest)) return std::nullopt;
  return nearest;
}

}  // namespace turnscan
