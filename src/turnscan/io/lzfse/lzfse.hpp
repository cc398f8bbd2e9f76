#pragma once
// LZFSE, the compression of Apple's devices: blocks of Lempel-Ziv sequences behind a finite-state
// entropy coder (FSE), of LZVN (Lempel-Ziv in bytes), or stored. The format is defined by the
// documentation in the headers of its reference implementation (Apple Inc. 2016,
// github.com/lzfse/lzfse); this decoder is written from that description.

#include <cstddef>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::lzfse {

/// Whether the bytes begin as a stream of LZFSE does ("bvx" and one of -, 1, 2, n, $).
bool looks_like_lzfse(std::string_view bytes);

/// Decodes a stream of blocks to its end mark; what follows that is ignored. Memory grows with what
/// the blocks can hold, never with what they claim.
/// Fails with kFormat where the stream is damaged or cut off (with the offset of the block), and
/// with kResourceLimit when it holds more than max_bytes.
Result<std::string> decode(std::string_view stream, std::size_t max_bytes);

}  // namespace turnscan::lzfse
