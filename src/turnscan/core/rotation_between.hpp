#pragma once
// The shortest rotation from one direction to another.

#include <Eigen/Geometry>
#include <turnscan/core/pose.hpp>

namespace turnscan {

/// The shortest rotation that takes the direction `from` to the direction `to`; about an arbitrary
/// perpendicular axis if they are opposite. Both may have any length above 0. Bitwise identical to
/// Eigen::Quaterniond::FromTwoVectors, whose matrix decompositions take ten seconds to compile.
Eigen::Quaterniond rotation_between(const Vec3d& from, const Vec3d& to);

}  // namespace turnscan
