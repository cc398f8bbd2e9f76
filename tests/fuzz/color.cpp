#include <turnscan/io/image/image_io.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(color) {
  turnscan::Frame frame;
  if (!turnscan::decode_frame_color(turnscan::fuzz::text_of(data, size), frame)) return 0;
  const turnscan::ColorImage& read = frame.color;
  turnscan::fuzz::require(read.pixels.size() == std::size_t(read.width) * std::size_t(read.height),
                          "size");
  // What a recording would take as a file has to be one.
  if (frame.color_jpeg.empty()) return 0;
  const auto again = turnscan::decode_color(frame.color_jpeg);
  turnscan::fuzz::require(again && again->width == read.width, "the file that is kept");
  return 0;
}
