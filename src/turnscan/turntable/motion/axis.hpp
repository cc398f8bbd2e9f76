#pragma once
// The axis of rotation as four unknowns: two tilts and two shifts of its centre.

#include <Eigen/Core>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <utility>

namespace turnscan::motion {

/// Two directions at right angles to n, and to each other.
std::pair<Vec3d, Vec3d> tangent_basis(const Vec3d& n);

/// Moves axis and centre by tilts and shifts about tangent_basis(axis). Returns the size of both.
std::pair<double, double> move_axis(const Eigen::Vector4d& step, Vec3d& axis, Vec3d& center);

/// Where the axis roughly is: the platter, where one was seen; it may wobble. Adds to the normal
/// equations of two tilts and two shifts about tangent_basis(axis); unit: weight of one.
void add_axis_prior(const MotionData& data, const Vec3d& axis, const Vec3d& center, double unit,
                    Eigen::Ref<Eigen::Matrix4d> normal, Eigen::Ref<Eigen::Vector4d> right);

}  // namespace turnscan::motion
