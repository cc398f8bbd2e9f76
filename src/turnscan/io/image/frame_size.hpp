#pragma once
// How large the images of a frame may be. A few kilobytes can unpack to the most that any image may
// have, and of frames several are held at once, with a ray for each pixel of depth.

#include <cstdint>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

/// Cameras of structured light have up to 12 million pixels.
inline constexpr std::uint64_t kMaxDepthPixels = std::uint64_t(4096) * 3072;
/// Cameras of 24 million pixels are used beside them.
inline constexpr std::uint64_t kMaxFrameColorPixels = std::uint64_t(1) << 25;

/// Fails with kResourceLimit.
inline Result<> check_pixels(std::uint64_t width, std::uint64_t height, std::uint64_t most) {
  if (width >= 1 && height >= 1 && width <= 65535 && height <= 65535 && width * height <= most)
    return {};
  return fail(ErrorCode::kResourceLimit, "the image has {} x {} pixels: at most {} are allowed",
              width, height, most);
}

}  // namespace turnscan::image
