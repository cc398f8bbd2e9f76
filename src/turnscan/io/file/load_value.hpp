#pragma once
// Reads numbers from the bytes of a file.

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace turnscan::file {

/// Loads a value from any address, aligned or not. kSwap: from the opposite byte order of this
/// machine.
template <class T, bool kSwap>
T load(const char* from) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

}  // namespace turnscan::file
