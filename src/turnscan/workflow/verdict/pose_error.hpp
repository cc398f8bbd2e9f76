#pragma once
// What a turntable that is not where it is thought to be does to a surface.

#include <turnscan/core/pose.hpp>

namespace turnscan {

struct ScanKnowledge;

/// How far the axis may be off towards the sensors: a place is seen where it faces them, so that
/// such an axis makes the object larger or smaller. Off to the side it turns the whole.
struct PoseError {
  double shift_m = 0.0;
  double tilt_rad = 0.0;

  /// Of a place, in the mesh's frame: arm from the middle of the mesh, unit normal. A shift moves
  /// what stands upright; a tilt turns each place, as it faces the sensors, about the horizontal
  /// through the middle. What lies flat is seen from all around, which averages both out.
  double along_normal_m(const Vec3d& arm_m, const Vec3d& normal) const;
};

/// By the stated deviations of a calibration from motion, or half of what the checks or the platter
/// found against the recorded one, which may be either's error.
PoseError pose_error(const ScanKnowledge& known);

}  // namespace turnscan
