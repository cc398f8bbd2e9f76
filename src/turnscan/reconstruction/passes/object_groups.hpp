#pragma once
// Objects of passes that were recognised as one, and where its parts lie.

#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/reconstruction/passes/pair_verdict.hpp>

namespace turnscan::passes {

/// An object of a pass; surface must outlive it.
struct TableObject {
  std::size_t pass = 0, object = 0;
  const PreparedPass* surface = nullptr;
};

/// Two of them, by number, and whether they are one.
struct JudgedPair {
  std::size_t a = 0, b = 0;
  PairVerdict verdict;
};

struct ObjectGroup {
  std::vector<std::size_t> members;  ///< numbers of objects, ascending
  std::vector<Pose> T_here_member;
};

/// Unites what the verdicts are certain of, the surest first. An object is in one group, and a
/// group has at most one of a pass. Groups that contradict each other where the verdict puts them
/// stay apart, and the verdict gets that reason. Where single objects are left over, whole groups
/// are searched for in each other: what overlaps with none of the passes enough may do so with all
/// of them together. Fails with kCancelled.
Result<std::vector<ObjectGroup>> group_objects(std::span<const TableObject> objects,
                                               std::vector<JudgedPair>& verdicts,
                                               const JoinOptions& options,
                                               const RunContext& context);

}  // namespace turnscan::passes
