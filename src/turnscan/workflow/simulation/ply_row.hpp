#pragma once
// Rows of a binary PLY file.

#include <array>
#include <bit>
#include <cstring>
#include <span>

namespace turnscan::workflow {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie");

/// Little-endian bytes, one value after the other, without padding. Holds 96 bytes.
class PlyRow {
 public:
  template <class... T>
  explicit PlyRow(T... values) {
    static_assert((sizeof(T) + ...) <= 96);
    (add(values), ...);
  }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(bytes_).first(used_)); }

 private:
  template <class T>
  void add(T value) {
    std::memcpy(bytes_.data() + used_, &value, sizeof value);
    used_ += sizeof value;
  }
  std::array<char, 96> bytes_{};
  std::size_t used_ = 0;
};

}  // namespace turnscan::workflow
