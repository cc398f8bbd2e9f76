#pragma once
// Which objects of two passes are the same, where several stand on the table.

#include <span>
#include <turnscan/reconstruction/passes/pair_verdict.hpp>

namespace turnscan::passes {

/// The verdicts of all objects of a pass (rows) with all of another one.
using VerdictTable = std::vector<std::vector<PairVerdict>>;

/// Keeps those of the best assignment and turns the others down, with a reason; those, too, that
/// another assignment has nearly as much evidence for, unless the objects that it confuses are of
/// the same shape wherever they were measured. Then either is right, and the verdict says so.
void match_objects(std::span<const PreparedPass* const> a, std::span<const PreparedPass* const> b,
                   VerdictTable& verdicts);

}  // namespace turnscan::passes
