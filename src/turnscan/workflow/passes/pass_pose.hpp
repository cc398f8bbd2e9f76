#pragma once
// Where a pass lies, as a person states it.

#include <string>
#include <turnscan/core/pose.hpp>

namespace turnscan {

struct PassPose {
  std::uint32_t pass = 0;
  Pose T_first_table = Pose::Identity();  ///< from its table frame to that of the first pass
  /// It lies only about there: its surface is brought onto that of the others from there, and must
  /// fit.
  bool refine = false;
};

/// "PASS=FILE": the rows of a 4x4 matrix in metres, numbers with spaces, commas or line ends
/// between them, as CloudCompare and MeshLab write it. "PASS=RX,RY,RZ,TX,TY,TZ": turned about the
/// fixed axes x, then y, then z, then shifted; each with its unit. Fails with kInvalidOption, and
/// as read_file() and pose_from() do.
Result<PassPose> parse_pass_pose(const std::string& text);

}  // namespace turnscan
