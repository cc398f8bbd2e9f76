#pragma once
// The unknowns of calibration from motion.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::motion {

/// Residuals beyond this many robust standard deviations are downweighted (Huber 1964).
inline constexpr double kHuber = 1.5;

struct MotionState {
  Vec3d axis = Vec3d::UnitY();   ///< unit, sensor frame
  Vec3d center = Vec3d::Zero();  ///< a point on the axis
  std::vector<double> angle;     ///< per frame of MotionData, radians
  /// Two views of an object at azimuths d apart (-pi to pi) appear to be apart by rotation_bias[0]
  /// d + rotation_bias[1] d |d| more, some thousandths, which silhouettes and occluded parts cause.
  std::array<double, 2> rotation_bias{};
};

/// The samples of `from` are compared with the surface of `to`, a key frame.
struct FramePair {
  std::uint32_t from, to;
};

}  // namespace turnscan::motion
