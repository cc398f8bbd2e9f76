// The input is the width, the height, the layout, and the bytes of the image.

#include <turnscan/io/image/yuv.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(raw_color) {
  using namespace turnscan;
  if (size < 3) return 0;
  const int width = 1 + data[0] % 64, height = 1 + data[1] % 64;
  const auto layout = static_cast<image::RawColor>(data[2] % 3);
  const auto read =
      image::decode_raw_color(fuzz::text_of(data + 3, size - 3), width, height, layout);
  if (!read) return 0;
  fuzz::require(read->width == width && read->height == height, "size");
  fuzz::require(read->pixels.size() == std::size_t(width) * std::size_t(height), "pixels");
  return 0;
}
