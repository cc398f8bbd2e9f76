// LZVN: each instruction states how many literal bytes follow (L), and how many bytes (M) are
// repeated from which distance (D). Its first byte, from the highest bit:
//   LLMMMDDD DDDDDDDD            small distance (MMM + 3)
//   LLMMM110                     the previous distance
//   LLMMM111 D (16 bit)          large distance
//   101LLMMM DDDDDDMM DDDDDDDD   medium distance (MMMMM + 3)
//   1110LLLL, 11100000 L         literals only: 1 to 15, or 16 plus the next byte
//   1111MMMM, 11110000 M         a match at the previous distance
//   00000110 and seven bytes     the end;  00001110, 00010110: nothing

#include <cstdint>
#include <turnscan/io/lzfse/lzvn.hpp>

namespace turnscan::lzfse {

namespace {

class LzvnReader {
 public:
  LzvnReader(std::string_view payload, BlockOutput& output) : payload_(payload), output_(output) {}

  bool run() {
    while (at_ < payload_.size()) {
      const unsigned code = static_cast<unsigned char>(payload_[at_]);
      if (code == 0x06) return payload_.size() - at_ == 8 && output_.full();
      if (code == 0x0e || code == 0x16) {
        ++at_;
        continue;
      }
      if (!step(code)) return false;
    }
    return false;
  }

 private:
  bool step(unsigned code) {
    const unsigned high = code >> 4;
    if (high == 0x7 || high == 0xd) return false;
    if (high == 0xe) return bytes_only(code & 15U);
    if (high == 0xf) return repeat_only(code & 15U);
    if (high == 0xa || high == 0xb) return medium(code);
    if ((code & 7U) == 7) return large(code);
    if ((code & 7U) == 6) return code >= 0x40 && both(1, code >> 6, (code >> 3 & 7U) + 3);
    return small(code);
  }

  bool small(unsigned code) {
    if (!has(2)) return false;
    distance_ = std::size_t(code & 7U) << 8 | number_at(payload_, at_ + 1, 1);
    return both(2, code >> 6, (code >> 3 & 7U) + 3);
  }

  bool medium(unsigned code) {
    if (!has(3)) return false;
    const std::uint64_t rest = number_at(payload_, at_ + 1, 2);
    distance_ = rest >> 2;
    return both(3, code >> 3 & 3U, ((code & 7U) << 2 | (rest & 3U)) + 3);
  }

  bool large(unsigned code) {
    if (!has(3)) return false;
    distance_ = number_at(payload_, at_ + 1, 2);
    return both(3, code >> 6, (code >> 3 & 7U) + 3);
  }

  bool bytes_only(std::size_t count) {
    if (count != 0) return both(1, count, 0);
    return has(2) && both(2, number_at(payload_, at_ + 1, 1) + 16, 0);
  }

  bool repeat_only(std::size_t count) {
    if (count != 0) return both(1, 0, count);
    return has(2) && both(2, 0, number_at(payload_, at_ + 1, 1) + 16);
  }

  bool has(std::size_t count) const { return payload_.size() - at_ >= count; }

  bool both(std::size_t length, std::size_t literals, std::size_t match) {
    if (!has(length + literals)) return false;
    at_ += length;
    if (!output_.literals(payload_.data() + at_, literals)) return false;
    at_ += literals;
    return output_.match(distance_, match);
  }

  std::string_view payload_;
  BlockOutput& output_;
  std::size_t at_ = 0;
  std::size_t distance_ = 0;
};

}  // namespace

bool unpack_lzvn(std::string_view payload, BlockOutput& output) {
  return LzvnReader(payload, output).run();
}

}  // namespace turnscan::lzfse
