#pragma once
// Numbers in the bytes of a file.

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace turnscan::file {

/// A value that may lie at any address. kSwap: in the other byte order than this machine's.
template <class T, bool kSwap>
T load(const char* from) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

}  // namespace turnscan::file
