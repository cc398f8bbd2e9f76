#pragma once
// A hand that reaches over the turntable while it is watched, with the arm that it belongs to.

#include <optional>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct HandOptions {
  double at_s = 0.0;                     ///< when it starts to reach in,
  double duration_s = 0.0;               ///< and how long until it is gone again; 0: never
  double direction_rad = 1.57079632679;  ///< where it comes from, as a scanner's azimuth
  std::optional<double> height_m;        ///< of the palm above the platter

  bool happens() const { return duration_s != 0.0; }
};

OptionTable describe(HandOptions& hand);

/// Capsules for fingers, palm and arm, with colours. Its frame: the middle of the palm at the
/// origin, +Y up, the arm on the side of +Z.
TriangleMesh make_hand();

/// T_world_hand; none while it is away. It moves in for three tenths of its time, stays above the
/// centre (of the platter, world) for four, swaying a little, and moves out again.
std::optional<Pose> hand_pose(const HandOptions& hand, const Vec3d& centre, double time_s);

}  // namespace turnscan
