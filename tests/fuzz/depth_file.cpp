#include <turnscan/io/image/depth_file.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(depth_file) {
  using namespace turnscan;
  const auto read = decode_depth_file(fuzz::text_of(data, size), {1.0, true});
  if (!read) return 0;
  const DepthImage& image = read->image;
  fuzz::require(
      image.pixels.size() == std::size_t(image.width) * std::size_t(image.height) && !image.empty(),
      "pixels");
  return 0;
}
