#pragma once
// Decoder for finite-state entropy coding (J. Duda, "Asymmetric numeral systems", 2013; tables in
// LZFSE's layout).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace turnscan::lzfse {

/// Reads bits from the end of a byte range towards its beginning.
class BackwardBits {
 public:
  /// unused: number of bits to skip at the top of the last byte, 0 to 7.
  BackwardBits(std::string_view bytes, unsigned unused)
      : bytes_(bytes), left_(std::int64_t(bytes.size()) * 8 - std::int64_t(unused)) {}

  /// The next bits, at most 32. Beyond the beginning they are 0, and failed() returns true.
  std::uint32_t take(unsigned count);
  bool failed() const { return left_ < 0; }

 private:
  std::string_view bytes_;
  std::int64_t left_;
};

/// Transition of one decoder state.
struct FseState {
  std::uint16_t symbol = 0;
  std::uint8_t bits = 0;   ///< to read for the next state
  std::uint16_t base = 0;  ///< base of the next state, to which the bits are added
};

/// Fills the state table for normalised symbol frequencies, whose sum must not exceed the number of
/// states, a power of 2. States without a symbol lead to state 0. False if the sum is larger.
bool make_states(std::span<const std::uint16_t> frequencies, std::span<FseState> states);

}  // namespace turnscan::lzfse
