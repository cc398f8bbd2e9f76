#pragma once
// Passes of one object, in each of which it lies another way, and how they belong together.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/object_partition.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// A pass whose frames are fused with those of others. Its own table crops it: what touched the
/// platter in this pass is measured in another.
struct PassPlacement {
  /// From the frame of the pass's table to the object's, in which the mesh is made.
  Pose T_object_table = Pose::Identity();
  std::optional<TurntableInfo> turntable;  ///< that it was recorded on
  std::string name;                        ///< for people, e.g. "pass 1"
  std::optional<FoundMotion> found;        ///< nullopt: it was given, or is the first
  std::optional<ObjectPartition> share;    ///< other objects on its table are left out
};

}  // namespace turnscan
