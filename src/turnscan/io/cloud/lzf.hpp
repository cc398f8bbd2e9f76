#pragma once

#include <cstddef>
#include <string_view>

namespace turnscan::pcd {

/// Maximum compression ratio of LZF (M. Lehmann's LibLZF): 264 bytes into 3.
inline constexpr std::size_t kMaxLzfRatio = 88;

/// Unpacks into exactly `size` bytes at `target`; false if the content is damaged.
bool unpack_lzf(std::string_view packed, char* target, std::size_t size);

}  // namespace turnscan::pcd
