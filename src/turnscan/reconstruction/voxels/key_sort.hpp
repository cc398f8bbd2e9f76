#pragma once
// Stable radix sort by key, on all cores; the result does not depend on their number.

#include <cstdint>
#include <vector>

namespace turnscan::voxels {

struct KeyedItem {
  std::uint64_t key;
  std::uint32_t item;
};

/// Sorts in ascending order; items with equal keys keep their order. max_key: upper bound of the
/// keys.
void sort_by_key(std::vector<KeyedItem>& items, std::uint64_t max_key);

}  // namespace turnscan::voxels
