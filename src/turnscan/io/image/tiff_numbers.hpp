#pragma once
// Numbers of one image in a TIFF file, by libtiff.

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

/// Numbers in rows and columns, one after the other.
struct NumberImage {
  char kind = 0;         ///< 'u', 'i' or 'f'
  bool swapped = false;  ///< bytes are in the other order than the machine's
  std::size_t value_bytes = 0;
  std::uint32_t rows = 0, columns = 0;
};

struct TiffNumbers {
  NumberImage header;
  std::string values;
};

bool looks_like_tiff(std::string_view bytes);

/// The first image of the file: one number a pixel, of 8, 16 or 32 bits (floats: 32 or 64), in
/// strips, not packed or by LZW, deflate or PackBits. Colours, tiles and more than kMaxImagePixels
/// pixels fail with kUnsupported and kResourceLimit before memory is allocated; damaged and
/// truncated files with kFormat.
Result<TiffNumbers> decode_tiff_numbers(std::string_view bytes);

}  // namespace turnscan::image
