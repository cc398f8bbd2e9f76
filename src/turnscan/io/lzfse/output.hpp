#pragma once
// What the blocks of a stream write to: everything so far can be repeated, nothing beyond the
// block's announced size is written.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace turnscan::lzfse {

/// The place of one block in the decoded bytes.
class BlockOutput {
 public:
  /// Appends `size` bytes to `all` and writes there. all must outlive this.
  BlockOutput(std::string& all, std::size_t size) : all_(all), at_(all.size()) {
    all_.resize(at_ + size);
  }

  bool full() const { return at_ == all_.size(); }

  /// False when they do not fit.
  bool literals(const char* bytes, std::size_t count) {
    if (count > all_.size() - at_) return false;
    std::memcpy(all_.data() + at_, bytes, count);
    at_ += count;
    return true;
  }

  /// Repeats what stands `distance` bytes back; both may overlap. False when that lies before the
  /// beginning, or when it does not fit.
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

/// Little-endian number of `count` bytes at `at`, which must be there.
template <class Bytes>
std::uint64_t number_at(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= std::uint64_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

}  // namespace turnscan::lzfse
