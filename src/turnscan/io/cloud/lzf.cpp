#include <cstring>
#include <turnscan/io/cloud/lzf.hpp>

namespace turnscan::pcd {

namespace {

class Unpacker {
 public:
  Unpacker(std::string_view packed, char* target, std::size_t size)
      : packed_(packed), target_(target), size_(size) {}

  bool run() {
    while (in_ < packed_.size()) {
      const unsigned control = next();
      if (!(control < 32 ? copy_literals(control + 1) : copy_earlier(control))) return false;
    }
    return out_ == size_;
  }

 private:
  unsigned next() { return static_cast<unsigned char>(packed_[in_++]); }

  bool copy_literals(std::size_t count) {
    if (packed_.size() - in_ < count || size_ - out_ < count) return false;
    std::memcpy(target_ + out_, packed_.data() + in_, count);
    in_ += count;
    out_ += count;
    return true;
  }

  /// Length in the upper 3 bits (7: plus the next byte), distance in the remaining bits and another
  /// byte.
  bool copy_earlier(unsigned control) {
    std::size_t length = control >> 5;
    if (packed_.size() - in_ < (length == 7 ? 2U : 1U)) return false;
    if (length == 7) length += next();
    length += 2;
    const std::size_t distance = ((control & 31U) << 8 | next()) + 1;
    if (distance > out_ || size_ - out_ < length) return false;
    // Source and target may overlap: byte by byte.
    for (std::size_t i = 0; i < length; ++i, ++out_) target_[out_] = target_[out_ - distance];
    return true;
  }

  std::string_view packed_;
  char* target_;
  std::size_t size_;
  std::size_t in_ = 0;
  std::size_t out_ = 0;
};

}  // namespace

bool unpack_lzf(std::string_view packed, char* target, std::size_t size) {
  return Unpacker(packed, target, size).run();
}

}  // namespace turnscan::pcd
