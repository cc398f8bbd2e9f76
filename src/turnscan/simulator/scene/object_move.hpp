#pragma once
// A motion of the object on the turning platter: pushed, rotated, tipped.

#include <span>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct ObjectMove {
  double at_s = 0.0;           ///< since the first frame
  double shift_m = 0.0;        ///< along the platter
  double direction_rad = 0.0;  ///< of shift and tip, as a scanner's azimuth
  double turn_rad = 0.0;       ///< counter-clockwise seen from above
  double tip_rad = 0.0;

  bool happens() const { return shift_m != 0.0 || turn_rad != 0.0 || tip_rad != 0.0; }
};

OptionTable describe(ObjectMove& move);

/// Maps the objects from their initial to their final position; both in the frame of the platter,
/// whose azimuth 0 is -Z. They rotate about the vertical through the centre of their bounding box,
/// tip towards the direction, and stand with their lowest point at the same height as before.
Pose moved_objects(const ObjectMove& move, std::span<const TriangleMesh> objects);

}  // namespace turnscan
