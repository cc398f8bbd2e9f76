#pragma once
// Rigid transforms. A pose is named T_to_from: p_to = T_to_from * p_from.

#include <Eigen/Geometry>
#include <turnscan/core/eigen.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan {

using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;
using Pose = Eigen::Isometry3d;

/// Pose from translation and quaternion (Hamilton; any length above 1e-6). Fails with kFormat when
/// a value is not finite or the quaternion is zero.
Result<Pose> pose_from(const Vec3d& translation_m, double qx, double qy, double qz, double qw);

/// Pose from a row-major 4x4 matrix. Fails with kFormat unless it is finite, its last row is
/// 0 0 0 1 and its rotation is orthonormal to 1e-3 (it is then orthonormalised).
Result<Pose> pose_from(const Eigen::Matrix4d& matrix);

/// Rotation by angle_rad about +Y, counter-clockwise seen from above (from +Y).
Pose rotation_about_y(double angle_rad);

}  // namespace turnscan
