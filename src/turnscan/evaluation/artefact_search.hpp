#pragma once
// Finds an artefact among points: random triples, and the surface that most points support (RANSAC;
// Fischler and Bolles 1981).

#include <cstdint>
#include <optional>
#include <turnscan/core/run_context.hpp>
#include <turnscan/evaluation/robust_fit.hpp>
#include <vector>

namespace turnscan::artefact {

/// Points of a scan, with or without normals (then empty).
struct Points {
  std::vector<Vec3d> positions, normals;

  bool agrees(std::size_t i, const Vec3d& surface_normal) const;
};

/// The sphere of this radius, to within 5 %, with the most points on it; nullopt if fewer than 50
/// of at most 20,000 points are. Excludes centres nearer than two radii to one of `others`.
std::optional<Sphere> find_sphere(const Points& points, double radius,
                                  const std::vector<Sphere>& others, const RunContext& context);

/// The plane with the most points within 1 mm.
std::optional<Plane> find_plane(const Points& points, const RunContext& context);

}  // namespace turnscan::artefact
