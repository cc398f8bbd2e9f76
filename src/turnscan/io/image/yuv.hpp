#pragma once
// Raw colour images as delivered by cameras: luma and chroma of ITU-R BT.601 in limited range (16
// to 235, 16 to 240).

#include <cstdint>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

enum class RawColor : std::uint8_t {
  kNv12,  ///< a plane of Y, then one of Cb Cr pairs for each 2 x 2 pixels
  kYuy2,  ///< Y Cb Y Cr for each two pixels of a row
  kBgra   ///< blue, green, red, and an ignored byte
};

/// Rows are contiguous. Fails with kFormat if the size is not even where the layout requires that,
/// or if the number of bytes does not match. Precondition: width and height are in [1, 65535].
Result<ColorImage> decode_raw_color(std::string_view bytes, int width, int height, RawColor layout);

}  // namespace turnscan::image
