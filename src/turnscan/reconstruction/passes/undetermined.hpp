#pragma once
// Directions in which the shape leaves a motion undetermined.

#include <string>
#include <turnscan/reconstruction/passes/joint_adjustment.hpp>

namespace turnscan::passes {

/// Standard deviation of a motion with this covariance about the center, root mean square over the
/// pass's surface.
double surface_sigma(const PreparedPass& pass, const Pose& T_first_pass, const Vec3d& center,
                     const Matrix6& covariance);

/// The motion from `from` towards the adjusted one of the second of two passes, but only in
/// directions that are known to max_sigma_m.
Pose determined_part(const PreparedPass& pass, const Adjustment& adjustment, const Pose& from,
                     double max_sigma_m);

/// Description for display of the directions of the second of two adjusted passes that are not
/// known to max_sigma_m; empty if all are known.
std::string undetermined_direction(const PreparedPass& pass, const Adjustment& adjustment,
                                   double max_sigma_m);

}  // namespace turnscan::passes
