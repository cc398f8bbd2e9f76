#pragma once
// Objects made by formula, as passes: what join_passes() is tested with.

#include <functional>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::testing {

/// Distance of the surface from the origin in a direction.
using RadiusOf = std::function<double(const Vec3d& direction)>;

double lumpy_radius(const Vec3d& direction);
double ball_radius(const Vec3d& direction);
/// A vase that turns about y.
double vase_radius(const Vec3d& direction);

TriangleMesh star_mesh(const RadiusOf& radius);

/// Puts the object down so that its lowest point is at y = 0.
Pose set_down(const TriangleMesh& object, const Eigen::Matrix3d& rotation);

/// What a sensor sees of an object on a platter from 25 degrees up, all around: the vertices whose
/// normals do not look down, with noise, and views of it.
passes::PassSurface pass_of(const TriangleMesh& object, const Pose& T_table_object, double noise_m,
                            std::uint64_t seed);

}  // namespace turnscan::testing
