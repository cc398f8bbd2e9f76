#pragma once
// A hand, with its arm, that reaches over the turntable during the recording.

#include <optional>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct HandOptions {
  double at_s = 0.0;                     ///< when it starts to reach in,
  double duration_s = 0.0;               ///< and how long until it is gone again; 0: never
  double direction_rad = 1.57079632679;  ///< from which it comes, as a scanner's azimuth
  std::optional<double> height_m;        ///< of the palm above the platter

  bool happens() const { return duration_s != 0.0; }
};

OptionTable describe(HandOptions& hand);

/// Capsules for fingers, palm and arm, with colours. Its frame: origin in the middle of the palm,
/// +Y up, the arm on the side of +Z.
TriangleMesh make_hand();

/// T_world_hand; nullopt while it is absent. It moves in for three tenths of its duration, stays
/// above the centre (of the platter, world) for four, swaying a little, and moves out again.
std::optional<Pose> hand_pose(const HandOptions& hand, const Vec3d& centre, double time_s);

}  // namespace turnscan
