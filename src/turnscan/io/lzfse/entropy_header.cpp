#include <turnscan/io/lzfse/entropy_block.hpp>

namespace turnscan::lzfse {

namespace {

constexpr std::size_t kHeaderV1Bytes = 772;  // 770, padded to a multiple of 4
constexpr std::size_t kFrequenciesV1 = 50;
constexpr std::size_t kHeaderV2Bytes = 32;  // before the frequencies
constexpr std::uint32_t kMaxSequences = 10000;
constexpr std::uint32_t kMaxLiterals = 4 * kMaxSequences;
constexpr std::uint32_t kMaxL = 315, kMaxM = 2359;

std::uint32_t field(std::uint64_t word, unsigned from, unsigned bits) {
  return std::uint32_t(word >> from & ((std::uint64_t(1) << bits) - 1));
}

bool plausible(const EntropyHeader& h) {
  for (const std::uint16_t state : h.literal_state) {
    if (state >= 1024) return false;
  }
  return h.literals <= kMaxLiterals && h.sequences <= kMaxSequences && h.length_state < 64 &&
         h.match_state < 64 && h.distance_state < 256 && h.literal_unused < 8 &&
         h.sequence_unused < 8;
}

std::optional<EntropyHeader> if_plausible(const EntropyHeader& header) {
  return plausible(header) ? std::optional(header) : std::nullopt;
}

/// Reads frequencies in a prefix code, from the lowest bit up. Written with the highest bit first,
/// and x for the bits of the value:
///   x0       0 or 1
///   x01      2 or 3
///   xx011    4 to 7
///   xxxx0111 8 to 23
///   xxxxxxxxxx1111  24 to 1047
class FrequencyReader {
 public:
  explicit FrequencyReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint16_t next() {
    while (at_ < bytes_.size() && bits_ <= 24) {
      word_ |= std::uint32_t(static_cast<unsigned char>(bytes_[at_++])) << bits_;
      bits_ += 8;
    }
    if ((word_ & 1U) == 0) return value(0, 1, 1);
    if ((word_ & 3U) == 1) return value(2, 2, 1);
    if ((word_ & 7U) == 3) return value(4, 3, 2);
    if ((word_ & 15U) == 7) return value(8, 4, 4);
    return value(24, 4, 10);
  }

  /// Everything was consumed except the rest of the last byte.
  bool ended_well() const { return !failed_ && at_ == bytes_.size() && bits_ < 8; }

 private:
  std::uint16_t value(unsigned base, unsigned prefix, unsigned bits) {
    const unsigned out = base + field(word_, prefix, bits);
    failed_ = failed_ || prefix + bits > bits_;
    if (failed_) return 0;
    word_ >>= prefix + bits;
    bits_ -= prefix + bits;
    return std::uint16_t(out);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t word_ = 0;
  unsigned bits_ = 0;
  bool failed_ = false;
};

}  // namespace

std::uint64_t EntropyHeader::most_bytes() const {
  return std::uint64_t(sequences) * (kMaxL + kMaxM);
}

std::optional<EntropyHeader> parse_header_v1(std::string_view bytes) {
  if (bytes.size() < kHeaderV1Bytes) return std::nullopt;
  const auto word = [&](std::size_t at) { return std::uint32_t(number_at(bytes, at, 4)); };
  const auto half = [&](std::size_t at) { return std::uint16_t(number_at(bytes, at, 2)); };
  EntropyHeader h;
  h.size = kHeaderV1Bytes;
  h.raw_bytes = word(4);
  h.literals = word(12);
  h.sequences = word(16);
  h.literal_bytes = word(20);
  h.sequence_bytes = word(24);
  if (word(8) != h.payload()) return std::nullopt;
  // The numbers of bits are stored as negative: -7 to 0.
  h.literal_unused = 0U - word(28);
  for (std::size_t i = 0; i < 4; ++i) h.literal_state[i] = half(32 + 2 * i);
  h.sequence_unused = 0U - word(40);
  h.length_state = half(44);
  h.match_state = half(46);
  h.distance_state = half(48);
  for (std::size_t i = 0; i < kAllSymbols; ++i) h.frequencies[i] = half(kFrequenciesV1 + 2 * i);
  return if_plausible(h);
}

std::optional<EntropyHeader> parse_header_v2(std::string_view bytes) {
  if (bytes.size() < kHeaderV2Bytes) return std::nullopt;
  const std::uint64_t a = number_at(bytes, 8, 8), b = number_at(bytes, 16, 8),
                      c = number_at(bytes, 24, 8);
  EntropyHeader h;
  h.raw_bytes = std::uint32_t(number_at(bytes, 4, 4));
  h.literals = field(a, 0, 20);
  h.literal_bytes = field(a, 20, 20);
  h.sequences = field(a, 40, 20);
  h.literal_unused = 7 - field(a, 60, 3);
  for (unsigned i = 0; i < 4; ++i) h.literal_state[i] = std::uint16_t(field(b, 10 * i, 10));
  h.sequence_bytes = field(b, 40, 20);
  h.sequence_unused = 7 - field(b, 60, 3);
  h.size = field(c, 0, 32);
  h.length_state = std::uint16_t(field(c, 32, 10));
  h.match_state = std::uint16_t(field(c, 42, 10));
  h.distance_state = std::uint16_t(field(c, 52, 10));
  if (h.size < kHeaderV2Bytes || h.size > bytes.size()) return std::nullopt;
  if (h.size > kHeaderV2Bytes) {
    FrequencyReader reader(bytes.substr(kHeaderV2Bytes, h.size - kHeaderV2Bytes));
    for (std::uint16_t& frequency : h.frequencies) frequency = reader.next();
    if (!reader.ended_well()) return std::nullopt;
  }
  return if_plausible(h);
}

}  // namespace turnscan::lzfse
