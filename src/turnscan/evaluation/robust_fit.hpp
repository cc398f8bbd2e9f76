#pragma once
// Spheres and planes through points, with the rejection of points that VDI/VDE 2634 allows.

#include <functional>
#include <optional>
#include <span>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::artefact {

/// Both types have distance(p), signed, positive outside.
struct Sphere {
  Vec3d center = Vec3d::Zero();
  double radius = 0.0;
  double distance(const Vec3d& p) const { return (p - center).norm() - radius; }
  Vec3d normal(const Vec3d& p) const { return (p - center).normalized(); }
};
struct Plane {
  Vec3d point = Vec3d::Zero(), unit = Vec3d::UnitZ();
  double distance(const Vec3d& p) const { return unit.dot(p - point); }
  Vec3d normal(const Vec3d&) const { return unit; }
};

/// Least squares of the distances over centre and radius, or with fixed_radius over the centre
/// alone, from a start close to it (Gauss-Newton). nullopt: fewer than 4 points, or they do not
/// determine it.
std::optional<Sphere> fit_sphere(const std::vector<Vec3d>& points, const Sphere& start,
                                 bool fixed_radius);

/// Least squares of the distances; the normal is on the side of `start`'s. nullopt: fewer than 3
/// points.
std::optional<Plane> fit_plane(const std::vector<Vec3d>& points, const Plane& start);

/// Distances after a fit from which a share of the points was rejected.
struct Deviations {
  std::vector<double> kept;  ///< distances of the points that were not rejected, sorted
  std::size_t rejected = 0;
  double range() const { return kept.empty() ? 0.0 : kept.back() - kept.front(); }
  double sigma() const;
};

/// Rejects the floor(share N) points with the largest |distance|, fits to the others, and repeats
/// this until the same points are rejected, at most 50 times. `fit` fits a surface to points,
/// starting at the previous surface; returns nullopt if it does.
template <class Surface>
std::optional<Deviations> fit_rejecting(
    const std::vector<Vec3d>& points, double share, Surface& surface,
    const std::function<std::optional<Surface>(const std::vector<Vec3d>&, const Surface&)>& fit);

extern template std::optional<Deviations> fit_rejecting(
    const std::vector<Vec3d>&, double, Sphere&,
    const std::function<std::optional<Sphere>(const std::vector<Vec3d>&, const Sphere&)>&);
extern template std::optional<Deviations> fit_rejecting(
    const std::vector<Vec3d>&, double, Plane&,
    const std::function<std::optional<Plane>(const std::vector<Vec3d>&, const Plane&)>&);

}  // namespace turnscan::artefact
