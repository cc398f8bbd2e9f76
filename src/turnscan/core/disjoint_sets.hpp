#pragma once
// Disjoint sets (union-find) with path halving.

#include <cstdint>
#include <numeric>
#include <vector>

namespace turnscan {

/// Partition of the numbers [0, n) by union. The root of a set is its smallest member, so that
/// results do not depend on the order of the unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }
  /// Makes a number a singleton again; the sets are only valid after all members of its former set
  /// have been reset.
  void reset(std::uint32_t i) { parent_[i] = i; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace turnscan
