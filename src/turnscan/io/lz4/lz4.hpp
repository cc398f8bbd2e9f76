#pragma once
// LZ4 in two wrappings: liblz4's frames
// (https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md), and the blocks that Apple's
// Compression library writes for COMPRESSION_LZ4: "bv41", two sizes (unpacked, packed; 32 bits,
// little endian) and an LZ4 block, which may refer to what the blocks before it gave; "bv4-", a
// size and that many bytes as they are; "bv4$" at the end (Apple, "COMPRESSION_LZ4").

#include <cstddef>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::lz4 {

/// Whether the bytes begin as one of the two does.
bool looks_like_lz4(std::string_view bytes);

/// Decodes a frame or a stream of blocks to its end; what follows is ignored. Memory grows with
/// what is decoded, never beyond twice that or with what sizes claim.
/// Fails with kFormat where it is damaged, cut off, or neither of the two, with kResourceLimit when
/// it holds more than max_bytes, and with kLibrary when liblz4 gives no context.
Result<std::string> decode(std::string_view bytes, std::size_t max_bytes);

}  // namespace turnscan::lz4
