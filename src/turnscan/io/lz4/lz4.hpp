#pragma once
// Decodes LZ4 in two containers: liblz4's frames
// (https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md), and the blocks that Apple's
// Compression library writes for COMPRESSION_LZ4: "bv41", two sizes (unpacked, packed; 32 bits,
// little endian) and an LZ4 block, which may refer to the output of earlier blocks; "bv4-", a size
// and that many stored bytes; "bv4$" at the end (Apple, "COMPRESSION_LZ4").

#include <cstddef>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::lz4 {

/// Whether the bytes begin like either container.
bool looks_like_lz4(std::string_view bytes);

/// Decodes a frame or a stream of blocks to its end; trailing bytes are ignored. Memory grows with
/// the decoded data, never beyond twice its size or with the claimed sizes.
/// Fails with kFormat if it is damaged, truncated, or neither of the two, with kResourceLimit if it
/// holds more than max_bytes, and with kLibrary if liblz4 cannot create a context.
Result<std::string> decode(std::string_view bytes, std::size_t max_bytes);

}  // namespace turnscan::lz4
