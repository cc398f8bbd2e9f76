#include "serve/live_picture.hpp"

#include <algorithm>
#include <turnscan/io/image/image_io.hpp>

namespace turnscan::serve {

namespace {

constexpr int kWidth = 320;  // of a phone's page; no pixel of it is worth more bytes
constexpr int kQuality = 80;

/// Every n-th pixel, so that at most kWidth columns remain.
template <class T, class Value>
ColorImage reduced(const Image<T>& image, const Value& value) {
  const int every = std::max(1, (image.width + kWidth - 1) / kWidth);
  ColorImage out(image.width / every, image.height / every);
  for (int row = 0; row < out.height; ++row)
    for (int column = 0; column < out.width; ++column)
      out.at(column, row) = value(image.at(column * every, row * every));
  return out;
}

ColorImage greys(const DepthImage& depth) {
  std::vector<std::uint16_t> known;
  for (const std::uint16_t d : depth.pixels)
    if (d != kNoReturn && d != kOutsideCrop) known.push_back(d);
  if (known.empty()) known.push_back(1);
  std::sort(known.begin(), known.end());
  // Without the few that are far off, which would take most of the greys.
  const double near = known[known.size() / 50], far = known[known.size() - 1 - known.size() / 50];
  return reduced(depth, [&](std::uint16_t d) {
    if (d == kNoReturn || d == kOutsideCrop) return Rgb{};
    const double share = std::clamp((double(d) - near) / std::max(far - near, 1.0), 0.0, 1.0);
    const auto grey = static_cast<std::uint8_t>(255.0 - 200.0 * share);
    return Rgb{grey, grey, grey};
  });
}

}  // namespace

Result<std::string> live_picture(const LiveFrame& frame) {
  return encode_color_jpeg(frame.color.empty()
                               ? greys(frame.depth)
                               : reduced(frame.color, [](const Rgb& color) { return color; }),
                           kQuality);
}

}  // namespace turnscan::serve
