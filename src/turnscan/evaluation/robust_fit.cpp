#include <turnscan/evaluation/robust_fit.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::artefact {

std::optional<Sphere> fit_sphere(const std::vector<Vec3d>& points, const Sphere& start,
                                 bool fixed_radius) {
  constexpr int kIterations = 50;
  const int unknowns = fixed_radius ? 3 : 4;
  if (points.size() < 4) return std::nullopt;
  Sphere sphere = start;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // d = |p - c| - r: its derivative is minus the direction by c, and -1 by r.
    Eigen::Matrix4d normal_matrix = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const Vec3d& p : points) {
      Eigen::Vector4d row;
      row << -sphere.normal(p), -1.0;
      normal_matrix += row * row.transpose();
      right -= row * sphere.distance(p);
    }
    const auto solver = normal_matrix.topLeftCorner(unknowns, unknowns).ldlt();
    if (!(solver.rcond() > 1e-10)) return std::nullopt;
    const Eigen::VectorXd step = solver.solve(right.head(unknowns));
    sphere.center += step.head<3>();
    if (!fixed_radius) sphere.radius += step[3];
    if (!sphere.center.allFinite() || !(sphere.radius > 0.0)) return std::nullopt;
    if (step.norm() < 1e-12) break;
  }
  return sphere;
}

std::optional<Plane> fit_plane(const std::vector<Vec3d>& points, const Plane& start) {
  if (points.size() < 3) return std::nullopt;
  Plane plane;
  for (const Vec3d& p : points) plane.point += p;
  plane.point /= double(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3d& p : points) covariance += (p - plane.point) * (p - plane.point).transpose();
  plane.unit = estimation::symmetric_eigen(covariance).vectors.col(0);
  if (plane.unit.dot(start.unit) < 0.0) plane.unit = -plane.unit;
  return plane;
}

double Deviations::sigma() const {
  if (kept.size() < 2) return 0.0;
  const double mean = std::accumulate(kept.begin(), kept.end(), 0.0) / double(kept.size());
  double squares = 0.0;
  for (const double d : kept) squares += (d - mean) * (d - mean);
  return std::sqrt(squares / double(kept.size() - 1));
}

template <class Surface>
std::optional<Deviations> fit_rejecting(
    const std::vector<Vec3d>& points, double share, Surface& surface,
    const std::function<std::optional<Surface>(const std::vector<Vec3d>&, const Surface&)>& fit) {
  constexpr int kRounds = 50;
  const auto rejected = static_cast<std::size_t>(std::floor(share * double(points.size())));
  const auto first_rejected = static_cast<std::ptrdiff_t>(points.size() - rejected);
  std::vector<std::uint32_t> order(points.size());
  std::vector<std::uint32_t> kept;
  std::vector<Vec3d> used = points;
  for (int round = 0; round < kRounds; ++round) {
    const std::optional<Surface> next = fit(used, surface);
    if (!next) return std::nullopt;
    surface = *next;
    if (rejected == 0) break;
    std::iota(order.begin(), order.end(), 0u);
    const auto error = [&](std::uint32_t i) { return std::abs(surface.distance(points[i])); };
    // By index if distances are equal, so that the same points are rejected in every run.
    std::nth_element(order.begin(), order.begin() + first_rejected, order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double da = error(a), db = error(b);
                       return da != db ? da < db : a < b;
                     });
    std::vector<std::uint32_t> now(order.begin(), order.begin() + first_rejected);
    std::sort(now.begin(), now.end());
    if (now == kept) break;
    kept = std::move(now);
    used.clear();
    for (const std::uint32_t i : kept) used.push_back(points[i]);
  }
  Deviations deviations;
  deviations.rejected = rejected;
  for (const Vec3d& p : used) deviations.kept.push_back(surface.distance(p));
  std::sort(deviations.kept.begin(), deviations.kept.end());
  return deviations;
}

template std::optional<Deviations> fit_rejecting(
    const std::vector<Vec3d>&, double, Sphere&,
    const std::function<std::optional<Sphere>(const std::vector<Vec3d>&, const Sphere&)>&);
template std::optional<Deviations> fit_rejecting(
    const std::vector<Vec3d>&, double, Plane&,
    const std::function<std::optional<Plane>(const std::vector<Vec3d>&, const Plane&)>&);

}  // namespace turnscan::artefact
