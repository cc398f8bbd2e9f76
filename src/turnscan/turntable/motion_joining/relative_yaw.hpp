#pragma once
// Relative pose of two sensors' table frames when both observed the same object turn.

#include <turnscan/turntable/motion/sensor_motion.hpp>

namespace turnscan::motion {

/// Maps a point from the second sensor's table frame to the first's.
struct RelativeYaw {
  double turn_rad = 0.0;  ///< about +Y
  double height_m = 0.0;  ///< along +Y
  double turn_sigma_rad = 0.0, height_sigma_m = 0.0;
  double rms_m = 0.0;  ///< root mean square of the distances between the models
  /// False if the object looks the same from all sides, or from several.
  bool determined = true;
  Pose pose() const;
};

/// Compares the models of both sensors: all yaws first, then least squares over yaw and height
/// (point to plane). Axis and centre of both stay as estimated from each sensor's own motion. Fails
/// with kMissingData if the models do not overlap, with kCancelled.
Result<RelativeYaw> find_relative_yaw(const SensorMotion& first, const SensorMotion& second,
                                      const RunContext& context);

}  // namespace turnscan::motion
