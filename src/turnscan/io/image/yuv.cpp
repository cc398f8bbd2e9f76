#include <algorithm>
#include <turnscan/io/image/yuv.hpp>

namespace turnscan::image {

namespace {

std::uint8_t clamped_8bit(int value) { return std::uint8_t(std::clamp(value, 0, 255)); }

/// BT.601, coefficients times 256.
Rgb rgb_of(int y, int cb, int cr) {
  const int luma = 298 * (y - 16) + 128, b = cb - 128, r = cr - 128;
  return {clamped_8bit((luma + 409 * r) >> 8), clamped_8bit((luma - 100 * b - 208 * r) >> 8),
          clamped_8bit((luma + 516 * b) >> 8)};
}

}  // namespace

Result<ColorImage> decode_raw_color(std::string_view bytes, int width, int height,
                                    RawColor layout) {
  const bool even = layout == RawColor::kBgra ||
                    (width % 2 == 0 && (layout == RawColor::kYuy2 || height % 2 == 0));
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  const std::size_t size = layout == RawColor::kNv12   ? pixels * 3 / 2
                           : layout == RawColor::kYuy2 ? pixels * 2
                                                       : pixels * 4;
  if (!even || bytes.size() != size)
    return fail(ErrorCode::kFormat, "an image of {} x {} pixels does not have {} bytes", width,
                height, bytes.size());
  ColorImage image(width, height);
  const auto byte = [&](std::size_t i) { return int(static_cast<unsigned char>(bytes[i])); };
  const std::size_t row_bytes = std::size_t(width);
  for (std::size_t v = 0; v < std::size_t(height); ++v) {
    for (std::size_t u = 0; u < std::size_t(width); ++u) {
      Rgb& out = image.pixels[v * row_bytes + u];
      if (layout == RawColor::kNv12) {
        const std::size_t chroma = pixels + v / 2 * row_bytes + u / 2 * 2;
        out = rgb_of(byte(v * row_bytes + u), byte(chroma), byte(chroma + 1));
      } else if (layout == RawColor::kYuy2) {
        const std::size_t pair = 2 * v * row_bytes + u / 2 * 4;
        out = rgb_of(byte(pair + u % 2 * 2), byte(pair + 1), byte(pair + 3));
      } else {
        const std::size_t at = 4 * (v * row_bytes + u);
        out = {std::uint8_t(byte(at + 2)), std::uint8_t(byte(at + 1)), std::uint8_t(byte(at))};
      }
    }
  }
  return image;
}

}  // namespace turnscan::image
