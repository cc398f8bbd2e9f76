#pragma once
// Finite-state entropy coding, the decoder's side (J. Duda, "Asymmetric numeral systems", 2013;
// the tables as LZFSE lays them out).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace turnscan::lzfse {

/// Bits that are read from the end of some bytes towards their beginning.
class BackwardBits {
 public:
  /// unused: of the last byte, 0 to 7 bits at its top.
  BackwardBits(std::string_view bytes, unsigned unused)
      : bytes_(bytes), left_(std::int64_t(bytes.size()) * 8 - std::int64_t(unused)) {}

  /// The next bits, at most 32. Beyond the beginning they are 0, and failed() holds.
  std::uint32_t take(unsigned count);
  bool failed() const { return left_ < 0; }

 private:
  std::string_view bytes_;
  std::int64_t left_;
};

/// What one state of the decoder does.
struct FseState {
  std::uint16_t symbol = 0;
  std::uint8_t bits = 0;   ///< to read for the next state
  std::uint16_t base = 0;  ///< of the next state, to which the bits are added
};

/// Fills the table of states for normalised frequencies of the symbols, whose sum must not exceed
/// the number of states, a power of 2. States that no symbol has lead to state 0.
/// False when the sum is larger.
bool make_states(std::span<const std::uint16_t> frequencies, std::span<FseState> states);

}  // namespace turnscan::lzfse
