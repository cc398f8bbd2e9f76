#pragma once
// What is known of the angles and of the axis without looking at the object, as equations.
// Internal to turntable: not installed.

#include <functional>
#include <span>
#include <turnscan/turntable/motion_solve.hpp>
#include <utility>

namespace turnscan::detail {

/// A coefficient and which of the angles it belongs to.
using LawTerm = std::pair<int, double>;
/// One equation: sum of coefficient * step = -error, with this many units' worth of weight.
using AddLawRow =
    std::function<void(std::span<const LawTerm> terms, double error, double inverse_variance)>;

/// The motor's law for the angles of `frames` (positions in data.frames, increasing). Returns -2
/// times the logarithm of its probability, up to a constant.
double add_law(const MotionData& data, const std::vector<std::size_t>& frames,
               const std::vector<double>& angle, const AngleLaw& law, const AddLawRow& add);

/// Where the axis roughly is: the platter, where one was seen; it may wobble. Adds to the normal
/// equations of two tilts and two shifts about `across(axis)`; unit: weight of one.
void add_axis_prior(const MotionData& data, const Vec3d& axis, const Vec3d& center, double unit,
                    Eigen::Ref<Eigen::Matrix4d> normal, Eigen::Ref<Eigen::Vector4d> right);

/// Two directions at right angles to n, and to each other.
std::pair<Vec3d, Vec3d> across(const Vec3d& n);

/// Moves axis and centre by tilts and shifts about across(axis). Returns the size of both.
std::pair<double, double> move_axis(const Eigen::Vector4d& step, Vec3d& axis, Vec3d& center);

}  // namespace turnscan::detail
