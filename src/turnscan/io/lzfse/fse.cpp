#include <algorithm>
#include <bit>
#include <cstring>
#include <turnscan/io/lzfse/fse.hpp>

namespace turnscan::lzfse {

std::uint32_t BackwardBits::take(unsigned count) {
  left_ -= count;
  if (left_ < 0) return 0;
  const std::size_t byte = std::size_t(left_) / 8, shift = std::size_t(left_) % 8;
  std::uint64_t word = 0;
  if (byte + 8 <= bytes_.size()) {
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(&word, bytes_.data() + byte, 8);
  } else {
    std::memcpy(&word, bytes_.data() + byte, bytes_.size() - byte);
  }
  return std::uint32_t(word >> shift & ((std::uint64_t(1) << count) - 1));
}

bool make_states(std::span<const std::uint16_t> frequencies, std::span<FseState> states) {
  std::fill(states.begin(), states.end(), FseState{});
  const int log_states = std::bit_width(states.size()) - 1;
  std::size_t next = 0;
  for (std::size_t symbol = 0; symbol < frequencies.size(); ++symbol) {
    const std::size_t frequency = frequencies[symbol];
    if (frequency == 0) continue;
    if (frequency > states.size() - next) return false;
    // The states of a symbol, counted from its frequency, are shifted up until they are between
    // once and twice the number of states; the lower ones by one bit more.
    const int shift = log_states - (std::bit_width(frequency) - 1);
    const std::size_t long_ones = (2 * states.size() >> shift) - frequency;
    for (std::size_t i = 0; i < frequency; ++i) {
      const unsigned bits = unsigned(shift) - (i < long_ones ? 0U : 1U);
      states[next++] = {std::uint16_t(symbol), std::uint8_t(bits),
                        std::uint16_t(((frequency + i) << bits) - states.size())};
    }
  }
  return true;
}

}  // namespace turnscan::lzfse
