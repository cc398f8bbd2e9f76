#pragma once

#include <cstddef>
#include <string_view>

namespace turnscan::pcd {

/// LZF (M. Lehmann's LibLZF) cannot pack more than this many bytes into one: 264 into 3.
inline constexpr std::size_t kMaxLzfRatio = 88;

/// Unpacks into exactly `size` bytes at `target`; false if the content is damaged.
bool unpack_lzf(std::string_view packed, char* target, std::size_t size);

}  // namespace turnscan::pcd
