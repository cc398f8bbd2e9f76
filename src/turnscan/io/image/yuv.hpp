#pragma once
// Colour images as cameras deliver them: luma and chroma of ITU-R BT.601 in their limited range
// (16 to 235, 16 to 240).

#include <cstdint>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

enum class RawColor : std::uint8_t {
  kNv12,  ///< a plane of Y, then one of Cb Cr for every two by two pixels
  kYuy2,  ///< Y Cb Y Cr for every two pixels of a row
  kBgra   ///< blue, green, red, and a byte that is dropped
};

/// Rows without gaps. Fails with kFormat when the size is not even where the layout needs that, or
/// the bytes are fewer or more than it takes. Precondition: width and height are in [1, 65535].
Result<ColorImage> decode_raw_color(std::string_view bytes, int width, int height, RawColor layout);

}  // namespace turnscan::image
