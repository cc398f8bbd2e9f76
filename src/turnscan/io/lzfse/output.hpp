#pragma once
// Output of a stream's blocks: matches may refer to everything written so far, and nothing is
// written beyond the block's announced size.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace turnscan::lzfse {

/// The output range of one block.
class BlockOutput {
 public:
  /// Appends `size` bytes to `all` and writes there. all must outlive this.
  BlockOutput(std::string& all, std::size_t size) : all_(all), at_(all.size()) {
    all_.resize(at_ + size);
  }

  bool full() const { return at_ == all_.size(); }

  /// False if they do not fit.
  bool literals(const char* bytes, std::size_t count) {
    if (count > all_.size() - at_) return false;
    std::memcpy(all_.data() + at_, bytes, count);
    at_ += count;
    return true;
  }

  /// Copies bytes from `distance` bytes back; source and target may overlap. False if the source is
  /// before the beginning, or the target does not fit.
  bool match(std::size_t distance, std::size_t count) {
    if (count == 0) return true;
    if (distance == 0 || distance > at_ || count > all_.size() - at_) return false;
    char* to = all_.data() + at_;
    if (distance >= count) {
      std::memcpy(to, to - distance, count);
    } else {
      for (std::size_t i = 0; i < count; ++i)
        to[i] = to[std::ptrdiff_t(i) - std::ptrdiff_t(distance)];
    }
    at_ += count;
    return true;
  }

 private:
  std::string& all_;
  std::size_t at_;
};

/// Little-endian number of `count` bytes at `at`, which must exist.
template <class Bytes>
std::uint64_t number_at(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= std::uint64_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

}  // namespace turnscan::lzfse
