#pragma once
// Colour images as PNG, two to three times as fast as libpng writes and reads them.

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/io/image/png_codec.hpp>

namespace turnscan::image {

/// pixels: three bytes each, row by row. Throws std::bad_alloc.
std::string encode_rgb(const unsigned char* pixels, std::uint32_t width, std::uint32_t height);

/// Decodes an image of 8-bit RGB into three bytes a pixel. False where libpng has the word, as of
/// decode_plain_depth(); what stands at `pixels` is undefined then.
bool decode_rgb(std::string_view bytes, const PngInfo& info, unsigned char* pixels);

}  // namespace turnscan::image
