#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <turnscan/io/lzfse/output.hpp>

namespace turnscan::lzfse {

/// Of L (literal lengths) and of M (match lengths).
inline constexpr std::size_t kLengthSymbols = 20;
inline constexpr std::size_t kDistanceSymbols = 64;
inline constexpr std::size_t kLiteralSymbols = 256;
inline constexpr std::size_t kAllSymbols = 2 * kLengthSymbols + kDistanceSymbols + kLiteralSymbols;

/// Header of a block of entropy-coded sequences, bvx1 or bvx2.
struct EntropyHeader {
  std::uint32_t raw_bytes = 0;
  std::uint32_t literals = 0;       ///< including up to three that pad a group of four
  std::uint32_t sequences = 0;      ///< triples of L, M and D
  std::uint32_t literal_bytes = 0;  ///< of the payload, which begins with the literals
  std::uint32_t sequence_bytes = 0;
  unsigned literal_unused = 0;  ///< unused bits at the top of the last byte
  unsigned sequence_unused = 0;
  std::array<std::uint16_t, 4> literal_state{};
  std::uint16_t length_state = 0, match_state = 0, distance_state = 0;
  std::array<std::uint16_t, kAllSymbols> frequencies{};  ///< of L, M, D and literals
  std::size_t size = 0;                                  ///< of the header

  std::uint64_t payload() const { return std::uint64_t(literal_bytes) + sequence_bytes; }
  /// Maximum output of its sequences.
  std::uint64_t most_bytes() const;
};

/// The header at the beginning of `bytes`; nullopt if it is damaged or truncated.
std::optional<EntropyHeader> parse_header_v1(std::string_view bytes);
std::optional<EntropyHeader> parse_header_v2(std::string_view bytes);

/// Unpacks header.payload() bytes; false if they are damaged or do not fill the output.
bool unpack_entropy(const EntropyHeader& header, std::string_view payload, BlockOutput& output);

}  // namespace turnscan::lzfse
