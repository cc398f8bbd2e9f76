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

/// How well a platter tells axis and centre of its turn (standard deviations in each direction): as
/// it was measured, and how square and central a platter is.
double platter_axis_sigma_rad(const DetectedPlatter& platter);
double platter_center_sigma_m(const DetectedPlatter& platter);

/// Where the axis is by the platter; nullptr: roughly before the sensor. Adds to the normal
/// equations of two tilts and two shifts about tangent_basis(axis); unit: weight of one.
void add_axis_prior(const DetectedPlatter* platter, const Vec3d& axis, const Vec3d& center,
                    double unit, Eigen::Ref<Eigen::Matrix4d> normal,
                    Eigen::Ref<Eigen::Vector4d> right);

struct AxisEstimate {
  Vec3d axis = Vec3d::UnitY();   ///< unit, sensor frame
  Vec3d center = Vec3d::Zero();  ///< a point of it, metres
  /// Of two tilts and two shifts about tangent_basis(axis), radians and metres.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

/// The best linear unbiased estimate from `all`, which has besides its noise a systematic error of
/// the covariance `bias`, and `part`, from part of the same data, which has none. The covariance of
/// efficient estimates from nested data is that of the larger set (Hausman 1978, "Specification
/// tests in econometrics"). Both axes lie within a few degrees of each other.
AxisEstimate combine_nested(const AxisEstimate& all, const AxisEstimate& part,
                            const Eigen::Matrix4d& bias);

}  // namespace turnscan::motion
