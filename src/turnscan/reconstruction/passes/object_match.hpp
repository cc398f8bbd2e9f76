#pragma once
// Matches the objects of two passes if several stand on the table.

#include <span>
#include <turnscan/reconstruction/passes/pair_verdict.hpp>

namespace turnscan::passes {

/// The verdicts of all objects of a pass (rows) with all of another one.
using VerdictTable = std::vector<std::vector<PairVerdict>>;

/// Keeps the verdicts of the best assignment and rejects the others with a reason; also rejects
/// those for which another assignment has nearly as much evidence, unless the objects that it
/// exchanges have the same shape wherever they were measured. Then both are right, and the verdict
/// is marked as interchangeable.
void match_objects(std::span<const PreparedPass* const> a, std::span<const PreparedPass* const> b,
                   VerdictTable& verdicts);

}  // namespace turnscan::passes
