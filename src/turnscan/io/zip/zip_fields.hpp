#pragma once
// Numbers of a zip archive's headers.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace turnscan::zip {

inline constexpr std::uint32_t kLocalHeader = 0x04034b50, kListHeader = 0x02014b50,
                               kEnd = 0x06054b50, kEnd64 = 0x06064b50, kEnd64Locator = 0x07064b50;
inline constexpr std::size_t kLocalHeaderBytes = 30;
inline constexpr std::uint16_t kEncrypted = 1, kSizesFollow = 8;  ///< flags

/// The little-endian number of `count` bytes at `at`; they must exist.
inline std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= std::uint64_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}
inline std::uint16_t half_at(std::string_view bytes, std::size_t at) {
  return std::uint16_t(number_at(bytes, at, 2));
}
inline std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return std::uint32_t(number_at(bytes, at, 4));
}

}  // namespace turnscan::zip
