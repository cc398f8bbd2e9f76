#pragma once
// The axis of rotation with four unknowns: two tilts, and two shifts of its centre.

#include <turnscan/core/eigen.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <utility>

namespace turnscan::motion {

/// Two unit directions perpendicular to n and to each other.
std::pair<Vec3d, Vec3d> tangent_basis(const Vec3d& n);

/// Moves axis and centre by tilts about and shifts along tangent_basis(axis). Returns the size of
/// both.
std::pair<double, double> move_axis(const Eigen::Vector4d& step, Vec3d& axis, Vec3d& center);

/// Accuracy of the axis and centre of rotation as given by a platter (standard deviations in each
/// direction): its measurement uncertainty, and how square and concentric platters are.
double platter_axis_sigma_rad(const DetectedPlatter& platter);
double platter_center_sigma_m(const DetectedPlatter& platter);

/// What is known of the axis besides the frames' motion.
struct AxisPrior {
  const DetectedPlatter* platter =
      nullptr;                        ///< nullptr: the axis is roughly in front of the sensor
  Vec3d to_sensor = -Vec3d::UnitZ();  ///< unit, from the object
  double view_shift_m = 0.0;          ///< view_shift_sigma_m() of the frames
};

/// With the platter of the frames, if one was seen and is wanted.
AxisPrior axis_prior(const MotionData& data, double view_shift_m, bool use_platter = true);

/// Adds to the normal equations of two tilts about and two shifts along tangent_basis(axis); unit:
/// weight of one. The centre is the apparent one, which view_shift_m moves along the view.
void add_axis_prior(const AxisPrior& prior, const Vec3d& axis, const Vec3d& center, double unit,
                    Eigen::Ref<Eigen::Matrix4d> normal, Eigen::Ref<Eigen::Vector4d> right);

struct AxisEstimate {
  Vec3d axis = Vec3d::UnitY();   ///< unit, sensor frame
  Vec3d center = Vec3d::Zero();  ///< a point on it, metres
  /// Covariance of two tilts about and two shifts along tangent_basis(axis), radians and metres.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

/// The axis of which `apparent` was estimated with this prior: where the platter says so, the
/// centre is moved back along the view. The covariance includes what remains unknown of that shift.
AxisEstimate without_view_shift(const AxisEstimate& apparent, const AxisPrior& prior);

/// Best linear unbiased estimate from `all`, which has besides its noise a systematic error of
/// covariance `bias`, and `part`, which comes from part of the same data and has none. The
/// covariance of efficient estimates from nested data is that of the larger set (Hausman 1978,
/// "Specification tests in econometrics"). The two axes must be within a few degrees of each other.
AxisEstimate combine_nested(const AxisEstimate& all, const AxisEstimate& part,
                            const Eigen::Matrix4d& bias);

}  // namespace turnscan::motion
