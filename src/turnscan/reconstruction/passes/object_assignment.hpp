#pragma once
// Which object of one pass is which of another.

#include <cstddef>
#include <optional>
#include <vector>

namespace turnscan::passes {

/// Evidence that row r and column c are one object; 0 or less: they are not.
using EvidenceTable = std::vector<std::vector<double>>;

struct Assignment {
  std::vector<std::optional<std::size_t>> column_of;  ///< per row; nullopt: it has no partner
  double evidence = 0.0;                              ///< sum over the pairs
};

/// The pairs, each row and each column in one at most, with the largest sum (the Hungarian method).
/// The table is a rectangle.
Assignment assign_objects(const EvidenceTable& evidence);

}  // namespace turnscan::passes
