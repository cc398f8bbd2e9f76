#pragma once
// Rigid motions as vectors: the exponential of a rotation and a translation about a point, and its
// inverse.

#include <turnscan/core/pose.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::estimation {

/// A small motion: a rotation vector times a lever, then the translation of a centre. With the
/// lever in metres all six are lengths; with a lever of 1 the first three are radians.
using Twist = Vector6d;

/// The rotation by |turn| radians about the direction of turn (Rodrigues).
Eigen::Matrix3d exp_so3(const Vec3d& turn);

/// The motion of a twist about a centre.
Pose exp_about(const Vec3d& center, const Twist& twist, double lever = 1.0);

/// The twist of a motion about a centre; its rotation is at most pi. Inverse of exp_about().
Twist log_about(const Vec3d& center, const Pose& motion, double lever = 1.0);

/// Orthonormalises a pose whose rotation has become inexact through many products.
Pose orthonormalised(Pose pose);

}  // namespace turnscan::estimation
