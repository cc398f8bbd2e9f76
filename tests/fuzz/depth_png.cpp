#include <turnscan/io/image/image_io.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(depth_png) {
  const auto read = turnscan::decode_depth_png(turnscan::fuzz::text_of(data, size));
  if (read)
    turnscan::fuzz::require(
        read->pixels.size() == std::size_t(read->width) * std::size_t(read->height), "size");
  return 0;
}
