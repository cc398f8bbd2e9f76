#pragma once
// The unknowns of calibration from motion.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::motion {

/// Residuals beyond this many robust standard deviations weigh less (Huber 1964).
inline constexpr double kHuber = 1.5;

struct MotionState {
  Vec3d axis = Vec3d::UnitY();   ///< unit, sensor frame
  Vec3d center = Vec3d::Zero();  ///< a point of the axis
  std::vector<double> angle;     ///< per frame of MotionData, radians
  /// Two views of one object from sides d apart (-pi to pi) seem to be apart by rotation_bias[0] d
  /// + rotation_bias[1] d |d| more: silhouettes and hidden places pull that way, by some
  /// thousandths.
  std::array<double, 2> rotation_bias{};
};

/// The samples of `from` are compared with the surface of `to`, a key frame.
struct FramePair {
  std::uint32_t from, to;
};

}  // namespace turnscan::motion
