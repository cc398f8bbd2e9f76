#pragma once
// LZFSE, Apple's compression format: blocks of Lempel-Ziv sequences with a finite-state entropy
// coder (FSE), of LZVN (bytewise Lempel-Ziv), or stored. The format is defined by the documentation
// in the headers of its reference implementation (Apple Inc. 2016, github.com/lzfse/lzfse); this
// decoder was written from that description.

#include <cstddef>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::lzfse {

/// Whether the bytes begin like an LZFSE stream ("bvx" and one of -, 1, 2, n, $).
bool looks_like_lzfse(std::string_view bytes);

/// Decodes a stream of blocks to its end marker; trailing bytes are ignored. Memory grows with what
/// the blocks can hold, never with the claimed sizes.
/// Fails with kFormat if the stream is damaged or truncated (with the offset of the block), and
/// with kResourceLimit if it holds more than max_bytes.
Result<std::string> decode(std::string_view stream, std::size_t max_bytes);

}  // namespace turnscan::lzfse
