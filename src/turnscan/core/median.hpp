#pragma once
// The median, without sorting.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace turnscan {

/// The upper median of an even number of values; if_empty if there are none. Reorders the values.
template <class T>
double median(std::vector<T>& values, double if_empty = 0.0) {
  if (values.empty()) return if_empty;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

}  // namespace turnscan
