#pragma once
// Evenly spaced subset.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace turnscan {

/// At most `most` elements of a list, in its order and evenly spaced, beginning with the first.
template <class T>
std::vector<T> evenly_spread(const std::vector<T>& list, std::size_t most) {
  const std::size_t n = std::min(most, list.size());
  std::vector<T> out;
  out.reserve(n);
  for (std::size_t k = 0; k < n; ++k) out.push_back(list[k * list.size() / n]);
  return out;
}

}  // namespace turnscan
