#pragma once
// How two sensors' tables lie to each other when both saw the same object turn.

#include <turnscan/turntable/motion/sensor_motion.hpp>

namespace turnscan::motion {

/// Takes a point from the second sensor's table frame to the first's.
struct RelativeYaw {
  double turn_rad = 0.0;  ///< about +Y
  double height_m = 0.0;  ///< along +Y
  double turn_sigma_rad = 0.0, height_sigma_m = 0.0;
  double rms_m = 0.0;  ///< of the distances between the models
  /// False when the object looks the same from all sides, or from several.
  bool determined = true;
  Pose pose() const;
};

/// Compares the models of both: all headings first, then least squares over heading and height
/// (point to plane). Axis and centre of both stay as each sensor's own motion shows them. Fails
/// with kMissingData when the models do not overlap, kCancelled.
Result<RelativeYaw> find_relative_yaw(const SensorMotion& first, const SensorMotion& second,
                                      const RunContext& context);

}  // namespace turnscan::motion
