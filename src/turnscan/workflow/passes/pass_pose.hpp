#pragma once
// Pose of a pass as stated by the user.

#include <string>
#include <turnscan/core/pose.hpp>

namespace turnscan {

struct PassPose {
  std::uint32_t pass = 0;
  Pose T_first_table = Pose::Identity();  ///< from its table frame to that of the first pass
  /// The pose is approximate: the surface is registered to the others starting from it, and must
  /// fit.
  bool refine = false;
};

/// Parses "PASS=FILE": the rows of a 4x4 matrix in metres, numbers separated by spaces, commas or
/// line ends, as written by CloudCompare and MeshLab; or "PASS=RX,RY,RZ,TX,TY,TZ": rotation about
/// the fixed axes x, then y, then z, then translation; each with its unit. Fails with
/// kInvalidOption, and as read_file() and pose_from() do.
Result<PassPose> parse_pass_pose(const std::string& text);

}  // namespace turnscan
