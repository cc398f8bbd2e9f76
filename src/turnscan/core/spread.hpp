#pragma once
// Evenly spaced subsets.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace turnscan {

/// At most `most` of the indices of n elements, ascending and evenly spaced, beginning with 0.
inline std::vector<std::size_t> evenly_spread(std::size_t n, std::size_t most) {
  std::vector<std::size_t> out(std::min(most, n));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = k * n / out.size();
  return out;
}

/// At most `most` elements of a vector or span, in its order and evenly spaced, beginning with the
/// first.
template <class List>
std::vector<typename List::value_type> evenly_spread(const List& list, std::size_t most) {
  std::vector<typename List::value_type> out;
  out.reserve(std::min(most, list.size()));
  for (const std::size_t i : evenly_spread(list.size(), most)) out.push_back(list[i]);
  return out;
}

/// As evenly_spread(), with both the first and the last element. most is 2 or more.
template <class T>
std::vector<T> evenly_spread_to_last(std::vector<T> list, std::size_t most) {
  const std::size_t n = list.size();
  if (n <= most) return list;
  for (std::size_t k = 0; k < most; ++k) list[k] = list[k * (n - 1) / (most - 1)];
  list.resize(most);
  return list;
}

}  // namespace turnscan
