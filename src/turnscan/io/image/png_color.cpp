#include <array>
#include <cstdlib>
#include <cstring>
#include <new>
#include <turnscan/io/image/png_color.hpp>
#include <turnscan/io/image/png_depth.hpp>
#include <vector>

namespace turnscan::image {

namespace {

constexpr std::size_t kChannels = 3;

/// a if `first` is 1, b if it is 0.
int either(int first, int a, int b) { return b ^ ((a ^ b) & -first); }

/// Paeth predictor of PNG (second edition, ISO/IEC 15948), 9.4: left, above or corner, whichever is
/// closest to left + above - corner. Branchless: with noise, branches are mispredicted half of the
/// time.
unsigned char paeth_of(int left, int above, int corner) {
  const int a = std::abs(above - corner), b = std::abs(left - corner);
  const int c = std::abs(left + above - 2 * corner);
  const int nearer = either(int(b <= c), above, corner);
  return static_cast<unsigned char>(either(int(a <= b) & int(a <= c), left, nearer));
}

/// The three channels have no data dependencies on each other.
void undo_paeth_rgb(unsigned char* row, const unsigned char* above, std::size_t size) {
  std::array<int, kChannels> left{}, corner{};
  for (std::size_t i = 0; i < size; i += kChannels)
    for (std::size_t c = 0; c < kChannels; ++c) {
      const int up = above[i + c];
      left[c] = (row[i + c] + paeth_of(left[c], up, corner[c])) & 255;
      row[i + c] = static_cast<unsigned char>(left[c]);
      corner[c] = up;
    }
}

}  // namespace

bool decode_rgb(std::string_view bytes, const PngInfo& info, unsigned char* pixels) try {
  const std::span<unsigned char> rows = unpack_plain(bytes, info, kChannels);
  if (rows.empty()) return false;
  const std::size_t row_bytes = kChannels * info.width;
  const unsigned char* above = rows.data();
  for (std::size_t y = 0; y < info.height; ++y) {
    unsigned char* row = rows.data() + row_bytes + y * (row_bytes + 1);
    if (!undo_filter(row[0], row + 1, above, row_bytes, kChannels, undo_paeth_rgb)) return false;
    std::memcpy(pixels + y * row_bytes, row + 1, row_bytes);
    above = row + 1;
  }
  return true;
} catch (const std::bad_alloc&) {
  return false;
}

std::string encode_rgb(const unsigned char* pixels, std::uint32_t width, std::uint32_t height) {
  const std::size_t row_bytes = kChannels * width;
  thread_local std::vector<unsigned char> filtered;
  filtered.resize(height * (row_bytes + 1));
  const std::vector<unsigned char> nothing(row_bytes, 0);
  const unsigned char* above = nothing.data();
  for (std::size_t y = 0; y < height; ++y) {
    const unsigned char* row = pixels + y * row_bytes;
    unsigned char* out = filtered.data() + y * (row_bytes + 1);
    *out++ = kPaeth;
    // A repeated row becomes all zeros.
    if (y > 0 && std::memcmp(row, above, row_bytes) == 0) {
      out[-1] = kUp;
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
