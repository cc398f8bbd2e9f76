#pragma once
// Effect of an error in the turntable's axis on a surface.

#include <turnscan/core/pose.hpp>

namespace turnscan {

struct ScanKnowledge;

/// Possible error of the axis towards the sensors. A surface point is measured while it faces them,
/// so that such an error makes the object larger or smaller. A sideways error rotates the whole
/// object.
struct PoseError {
  double shift_m = 0.0;
  double tilt_rad = 0.0;

  /// Error along the normal at a surface point, in the mesh's frame: arm from the centre of the
  /// mesh, unit normal. A shift displaces upright surfaces; a tilt rotates each point, while it
  /// faces the sensors, about the horizontal axis through the centre. Horizontal surfaces are seen
  /// from all around, which averages both out.
  double along_normal_m(const Vec3d& arm_m, const Vec3d& normal) const;
};

/// From the stated standard deviations of a calibration from motion, or half of the discrepancy
/// that the checks or the platter found against the recorded one, which may be the error of either.
PoseError pose_error(const ScanKnowledge& known);

}  // namespace turnscan
