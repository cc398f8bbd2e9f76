#pragma once
// Assigns the objects of one pass to those of another.

#include <cstddef>
#include <optional>
#include <vector>

namespace turnscan::passes {

/// Evidence that row r and column c are the same object; 0 or less: they are not.
using EvidenceTable = std::vector<std::vector<double>>;

struct Assignment {
  std::vector<std::optional<std::size_t>> column_of;  ///< per row; nullopt: it has no partner
  double evidence = 0.0;                              ///< sum over the pairs
};

/// The pairs, with each row and each column in at most one, that have the largest sum (the
/// Hungarian method). The table is rectangular.
Assignment assign_objects(const EvidenceTable& evidence);

}  // namespace turnscan::passes
