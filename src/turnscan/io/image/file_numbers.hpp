#pragma once
// Numbers of one image in a TIFF file, by libtiff, or in an OpenEXR file, by OpenEXR's own library.

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

struct FileNumbers {
  NumberImage header;
  std::string values;
};

bool looks_like_tiff(std::string_view bytes);
bool looks_like_exr(std::string_view bytes);

/// The first image of the file: one number a pixel, of 8, 16 or 32 bits (floats: 32 or 64), in
/// strips, not packed or by LZW, deflate or PackBits. Colours, tiles and more than kMaxImagePixels
/// pixels fail with kUnsupported and kResourceLimit before memory is allocated; damaged and
/// truncated files with kFormat.
Result<FileNumbers> decode_tiff_numbers(std::string_view bytes);

/// The first image of the file: its only channel, or the one that is named as depth (Z, or depth
/// in any layer), of floats, halves (floats here) or whole numbers, in rows, not packed or by a
/// codec that loses nothing or, of floats, no more than a 65,000th (PXR24). Fails as
/// decode_tiff_numbers does.
Result<FileNumbers> decode_exr_numbers(std::string_view bytes);

}  // namespace turnscan::image
