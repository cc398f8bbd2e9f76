#pragma once
// Content of the entry `metadata` (JSON) of a Record3D recording, according to its author's answers
// (github.com/marek-simonik/record3d, issues 27, 33, 36, 83, 93, 108).

#include <optional>
#include <string_view>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <vector>

namespace turnscan::record3d {

struct Metadata {
  /// For colour images of camera.width x camera.height; image coordinates are measured from the
  /// image's top left corner (Apple, ARCamera.intrinsics). The median over the frames if the file
  /// has a camera for each.
  CameraIntrinsics camera;
  double focal_change = 0.0;              ///< relative variation of the focal length
  int depth_width = 0, depth_height = 0;  ///< 0: not stated
  double fps = 0.0;                       ///< 0: not stated
  std::vector<double> times_s;            ///< of each frame, as stored; may be empty
  /// Camera to world, in OpenGL's camera convention; may be empty.
  std::vector<std::optional<Pose>> poses;
};

/// Fails with kFormat if a field is missing or wrong, and as the budget of the archive.
Result<Metadata> parse_metadata(std::string_view json, const file::ReadBudget& budget);

}  // namespace turnscan::record3d
