#pragma once
// Wrapper of libpng for plain arrays.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
bool looks_like_png(std::string_view bytes);

/// Decodes four big-endian bytes.
std::uint32_t big_endian_32(std::string_view bytes, std::size_t at);

/// Content of the first chunk.
struct PngInfo {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bit_depth = 0;   ///< 1, 2, 4, 8 or 16
  int color_type = 0;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  int channels() const;
};

/// Reads the first chunk and checks the size against the limits and against what a file of that
/// length can hold.
Result<PngInfo> read_png_info(std::string_view bytes);

enum class PngPixels {
  kDepth16,  ///< one std::uint16_t in the machine's byte order
  kRgb8,     ///< three bytes
  kGrey8     ///< one byte
};

/// Decodes into width * height pixels at `pixels`. Fails with kFormat.
Result<> decode_png(std::string_view bytes, const PngInfo& info, PngPixels kind,
                    unsigned char* pixels);

Result<std::string> encode_png(const unsigned char* pixels, int width, int height, PngPixels kind);

}  // namespace turnscan::image
