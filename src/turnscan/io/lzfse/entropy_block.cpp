#include <span>
#include <turnscan/io/lzfse/entropy_block.hpp>
#include <turnscan/io/lzfse/fse.hpp>
#include <vector>

namespace turnscan::lzfse {

namespace {

/// A symbol represents base plus this many extra bits.
struct SymbolValue {
  std::uint32_t base = 0;
  std::uint8_t bits = 0;
};

/// Consecutive value ranges without gaps, from the numbers of their extra bits.
template <std::size_t count>
constexpr std::array<SymbolValue, count> values_of(const std::array<std::uint8_t, count>& bits) {
  std::array<SymbolValue, count> values{};
  std::uint32_t base = 0;
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = {base, bits[i]};
    base += 1U << bits[i];
  }
  return values;
}

constexpr auto kLValues =
    values_of<kLengthSymbols>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 3, 5, 8});
constexpr auto kMValues =
    values_of<kLengthSymbols>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 5, 8, 11});
/// Four distances for each of 0, 1, 2, ... 15 extra bits.
constexpr auto kDValues = [] {
  std::array<std::uint8_t, kDistanceSymbols> bits{};
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = std::uint8_t(i / 4);
  return values_of(bits);
}();

/// Decoder of values: a table of states and the current one.
template <std::size_t states>
class ValueDecoder {
 public:
  ValueDecoder(std::span<const std::uint16_t> frequencies, std::uint16_t state) : state_(state) {
    good_ = make_states(frequencies, table_);
  }
  bool good() const { return good_; }

  template <std::size_t count>
  std::uint32_t next(BackwardBits& bits, const std::array<SymbolValue, count>& values) {
    const FseState& state = table_[state_];
    const SymbolValue& value = values[state.symbol];
    // The extra bits are below those of the next state.
    state_ = std::uint16_t(state.base + bits.take(state.bits));
    return value.base + bits.take(value.bits);
  }

 private:
  std::array<FseState, states> table_;
  std::uint16_t state_;
  bool good_ = false;
};

/// Four interleaved decoders. False if the payload is too short.
bool unpack_literals(const EntropyHeader& header, std::span<const std::uint16_t> frequencies,
                     std::string_view payload, std::vector<char>& literals) {
  std::array<FseState, 1024> table;
  if (!make_states(frequencies, table)) return false;
  BackwardBits bits(payload, header.literal_unused);
  std::array<std::uint16_t, 4> state = header.literal_state;
  literals.resize((std::size_t(header.literals) + 3) / 4 * 4);
  for (std::size_t i = 0; i < literals.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      const FseState& now = table[state[k]];
      literals[i + k] = char(now.symbol);
      state[k] = std::uint16_t(now.base + bits.take(now.bits));
    }
    if (bits.failed()) return false;
  }
  return true;
}

}  // namespace

bool unpack_entropy(const EntropyHeader& header, std::string_view payload, BlockOutput& output) {
  const std::span<const std::uint16_t> all(header.frequencies);
  std::vector<char> literals;
  if (!unpack_literals(header, all.subspan(2 * kLengthSymbols + kDistanceSymbols),
                       payload.substr(0, header.literal_bytes), literals))
    return false;
  ValueDecoder<64> length(all.subspan(0, kLengthSymbols), header.length_state);
  ValueDecoder<64> match(all.subspan(kLengthSymbols, kLengthSymbols), header.match_state);
  ValueDecoder<256> distance(all.subspan(2 * kLengthSymbols, kDistanceSymbols),
                             header.distance_state);
  if (!length.good() || !match.good() || !distance.good()) return false;
  BackwardBits bits(payload.substr(header.literal_bytes), header.sequence_unused);
  std::size_t used = 0, back = 0;
  for (std::uint32_t i = 0; i < header.sequences; ++i) {
    const std::size_t l = length.next(bits, kLValues), m = match.next(bits, kMValues),
                      d = distance.next(bits, kDValues);
    if (d != 0) back = d;  // 0: repeat the previous distance
    if (bits.failed() || l > literals.size() - used ||
        !output.literals(literals.data() + used, l) || !output.match(back, m))
      return false;
    used += l;
  }
  return output.full();
}

}  // namespace turnscan::lzfse
