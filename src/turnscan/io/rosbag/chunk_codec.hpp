#pragma once
// Compression of a chunk of a bag: none, bzip2, Zstandard, or an LZ4 frame (ROS's and MCAP's lz4 is
// liblz4's frame format: https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md).

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::rosbag {

enum class Packing : std::uint8_t { kNone, kBz2, kLz4, kZstd };

/// The compression named in a chunk's header. Fails with kUnsupported.
Result<Packing> packing_of(std::string_view name);

/// Unpacks to exactly `size` bytes; memory grows with the actual output. Fails with kFormat.
Result<std::string> unpack(Packing packing, std::string_view bytes, std::size_t size);

}  // namespace turnscan::rosbag
