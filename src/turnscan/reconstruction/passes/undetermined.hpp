#pragma once
// Directions in which the shape leaves a motion open.

#include <string>
#include <turnscan/reconstruction/passes/joint_adjustment.hpp>

namespace turnscan::passes {

/// Deviation of a motion with this covariance about the center, rms over the pass's surface.
double surface_sigma(const PreparedPass& pass, const Pose& T_first_pass, const Vec3d& center,
                     const Matrix6& covariance);

/// From `from` towards where the second of two passes was adjusted to, but only in directions that
/// are known to max_sigma_m.
Pose determined_part(const PreparedPass& pass, const Adjustment& adjustment, const Pose& from,
                     double max_sigma_m);

/// What is not known to max_sigma_m of the second of two adjusted passes, for people; empty where
/// everything is.
std::string undetermined_direction(const PreparedPass& pass, const Adjustment& adjustment,
                                   double max_sigma_m);

}  // namespace turnscan::passes
