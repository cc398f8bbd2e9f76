#include <cstdlib>
#include <cstring>
#include <turnscan/io/image/png_color.hpp>
#include <turnscan/io/image/png_depth.hpp>
#include <vector>

namespace turnscan::image {

namespace {

constexpr unsigned char kUpFilter = 2, kPaethFilter = 4;
constexpr std::size_t kChannels = 3;

/// PNG (second edition, ISO/IEC 15948), 9.4: of left, above and corner that which is nearest to
/// left + above - corner.
unsigned char paeth_of(int left, int above, int corner) {
  const int a = std::abs(above - corner), b = std::abs(left - corner);
  const int c = std::abs(left + above - 2 * corner);
  const int nearer = b <= c ? above : corner;
  return static_cast<unsigned char>(a <= b && a <= c ? left : nearer);
}

}  // namespace

std::string encode_rgb(const unsigned char* pixels, std::uint32_t width, std::uint32_t height) {
  const std::size_t row_bytes = kChannels * width;
  thread_local std::vector<unsigned char> filtered;
  filtered.resize(height * (row_bytes + 1));
  const std::vector<unsigned char> nothing(row_bytes, 0);
  const unsigned char* above = nothing.data();
  for (std::size_t y = 0; y < height; ++y) {
    const unsigned char* row = pixels + y * row_bytes;
    unsigned char* out = filtered.data() + y * (row_bytes + 1);
    *out++ = kPaethFilter;
    // Of a copied row nothing is left.
    if (y > 0 && std::memcmp(row, above, row_bytes) == 0) {
      out[-1] = kUpFilter;
      std::memset(out, 0, row_bytes);
      continue;
    }
    for (std::size_t x = 0; x < kChannels && x < row_bytes; ++x)
      out[x] = static_cast<unsigned char>(row[x] - above[x]);
    for (std::size_t x = kChannels; x < row_bytes; ++x)
      out[x] = static_cast<unsigned char>(
          row[x] - paeth_of(row[x - kChannels], above[x], above[x - kChannels]));
    above = row;
  }
  return pack_png(filtered, width, height, PlainPng::kRgb8);
}

}  // namespace turnscan::image
