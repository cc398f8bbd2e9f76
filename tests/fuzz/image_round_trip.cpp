// The input gives a size and pixels: images are written and read again, depth and PNG bit by bit.

#include <algorithm>
#include <turnscan/io/image/image_io.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(image_round_trip) {
  using namespace turnscan;
  if (size < 2) return 0;
  const int width = 1 + data[0] % 40, height = 1 + data[1] % 40;
  DepthImage depth(width, height);
  ColorImage color(width, height);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const auto byte = [&](std::size_t k) { return data[(2 + 3 * i + k) % size]; };
    depth.pixels[i] = static_cast<std::uint16_t>(byte(0) << 8 | byte(1));
    color.pixels[i] = {byte(0), byte(1), byte(2)};
  }
  const auto depth_bytes = encode_depth_png(depth);
  const auto depth_again = decode_depth_png(*depth_bytes);
  fuzz::require(depth_again && depth_again->pixels == depth.pixels, "depth bit by bit");
  const auto same = [](const Rgb& a, const Rgb& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
  };
  const auto color_again = decode_color(*encode_color_png(color));
  fuzz::require(
      color_again && std::equal(color.pixels.begin(), color.pixels.end(),
                                color_again->pixels.begin(), color_again->pixels.end(), same),
      "colour bit by bit");
  const auto jpeg_again = decode_color(*encode_color_jpeg(color, 1 + data[0] % 100));
  fuzz::require(jpeg_again && jpeg_again->width == width && jpeg_again->height == height,
                "the size of a JPEG image");
  return 0;
}
