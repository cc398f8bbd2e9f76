#pragma once
// An object that moves on the platter while it turns: pushed, turned, tipped.

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

/// Takes the objects from where they stood at first to where they stand then; both in the frame of
/// the platter, whose azimuth 0 is -Z. They turn about the vertical through the middle of their
/// box, tip to the direction, and stand with their lowest point as high as before.
Pose moved_objects(const ObjectMove& move, std::span<const TriangleMesh> objects);

}  // namespace turnscan
