#pragma once
// Groups of objects of several passes that are the same object, with their relative poses.

#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/reconstruction/passes/pair_verdict.hpp>

namespace turnscan::passes {

/// An object of a pass; surface must outlive it.
struct TableObject {
  std::size_t pass = 0, object = 0;
  const PreparedPass* surface = nullptr;
};

/// A pair of objects, by index, and the verdict whether they are the same.
struct JudgedPair {
  std::size_t a = 0, b = 0;
  PairVerdict verdict;
};

struct ObjectGroup {
  std::vector<std::size_t> members;  ///< indices of objects, ascending
  std::vector<Pose> T_here_member;
};

/// Merges pairs with certain verdicts, the most certain first. An object is in one group, and a
/// group has at most one object of a pass. Groups that contradict each other in the pose of a
/// verdict stay apart, and the verdict gets that as its reason. If single objects are left over,
/// whole groups are matched with each other: an object that overlaps too little with each of the
/// passes may overlap enough with all of them together. Fails with kCancelled.
Result<std::vector<ObjectGroup>> group_objects(std::span<const TableObject> objects,
                                               std::vector<JudgedPair>& verdicts,
                                               const JoinOptions& options,
                                               const RunContext& context);

}  // namespace turnscan::passes
