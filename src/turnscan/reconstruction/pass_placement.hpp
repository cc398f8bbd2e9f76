#pragma once
// Passes of one object in different poses, and their relative motion.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/object_partition.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// A pass whose frames are fused with those of others. It is cropped by its own table: what touched
/// the platter in this pass is measured in another.
struct PassPlacement {
  /// From the frame of the pass's table to the object's, in which the mesh is made.
  Pose T_object_table = Pose::Identity();
  std::optional<TurntableInfo> turntable;  ///< the one that it was recorded on
  std::string name;                        ///< display name, e.g. "pass 1"
  std::optional<FoundMotion> found;  ///< nullopt if the motion was given, or this is the first pass
  std::optional<ObjectPartition> share;  ///< other objects on its table are excluded
};

}  // namespace turnscan
