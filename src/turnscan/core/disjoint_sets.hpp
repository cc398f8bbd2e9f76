#pragma once
// Disjoint sets (union-find) with path halving.

#include <cstdint>
#include <numeric>
#include <vector>

namespace turnscan {

/// Sets of numbers [0, n) that merge. A set's root is its smallest member, so that nothing depends
/// on the order of the unions.
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
  /// Makes a number a set of its own again; the sets it was in hold only when all of their members
  /// are.
  void reset(std::uint32_t i) { parent_[i] = i; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace turnscan
