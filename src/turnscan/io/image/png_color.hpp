#pragma once
// Colour PNG images, written and read two to three times as fast as with libpng.

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/io/image/png_codec.hpp>

namespace turnscan::image {

/// pixels: three bytes each, row by row. Throws std::bad_alloc.
std::string encode_rgb(const unsigned char* pixels, std::uint32_t width, std::uint32_t height);

/// Decodes an 8-bit RGB image into three bytes per pixel. False if it has to be left to libpng, as
/// for decode_plain_depth(); the contents of `pixels` are undefined then.
bool decode_rgb(std::string_view bytes, const PngInfo& info, unsigned char* pixels);

}  // namespace turnscan::image
