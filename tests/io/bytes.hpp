#pragma once
// Files made by hand.

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace turnscan::testing {

enum class Order { kLittle, kBig };

template <class T>
std::string raw(T value, Order order = Order::kLittle) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if ((std::endian::native == std::endian::big) != (order == Order::kBig))
    std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

/// The values one after another.
template <class T, class... More>
std::string raw_all(Order order, T first, More... more) {
  std::string text = raw(first, order);
  ((text += raw(more, order)), ...);
  return text;
}

}  // namespace turnscan::testing
