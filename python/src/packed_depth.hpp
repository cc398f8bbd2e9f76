#pragma once
// Depth images that wait in memory.

#include <cstdint>
#include <cstring>
#include <turnscan/core/image.hpp>
#include <vector>

namespace turnscan::python {

/// A depth image without its long stretches of no return: where an object stands alone before the
/// sensor, a few hundredths of its size.
class PackedDepth {
 public:
  explicit PackedDepth(const DepthImage& image) : width_(image.width), height_(image.height) {
    const std::uint16_t* const begin = image.pixels.data();
    const std::size_t n = image.pixels.size();
    for (std::size_t at = skip_gap(begin, 0, n); at < n;) {
      const std::size_t end = end_of_run(begin, at, n);
      runs_.push_back({std::uint32_t(at), std::uint32_t(end - at)});
      pixels_.insert(pixels_.end(), begin + at, begin + end);
      at = skip_gap(begin, end, n);
    }
    pixels_.shrink_to_fit();
  }

  DepthImage unpacked() const {
    DepthImage image(width_, height_, kNoReturn);
    const std::uint16_t* from = pixels_.data();
    for (const Run& run : runs_) {
      std::memcpy(image.pixels.data() + run.at, from, run.count * sizeof(std::uint16_t));
      from += run.count;
    }
    return image;
  }

 private:
  struct Run {
    std::uint32_t at, count;
  };
  static constexpr std::size_t kGap = 16;  ///< shorter stretches of no return stay in their run

  /// The first pixel from `at` on that is a return; n without one.
  static std::size_t skip_gap(const std::uint16_t* pixels, std::size_t at, std::size_t n) {
    std::uint64_t four = 0;
    for (; at + 4 <= n; at += 4) {
      std::memcpy(&four, pixels + at, sizeof(four));
      if (four != 0) break;
    }
    while (at < n && pixels[at] == kNoReturn) ++at;
    return at;
  }

  /// Behind the last return before kGap pixels without one, or before the end.
  static std::size_t end_of_run(const std::uint16_t* pixels, std::size_t at, std::size_t n) {
    std::size_t end = at;
    for (; at < n && at - end < kGap; ++at)
      if (pixels[at] != kNoReturn) end = at + 1;
    return end;
  }

  static_assert(kNoReturn == 0);
  int width_, height_;
  std::vector<Run> runs_;
  std::vector<std::uint16_t> pixels_;
};

}  // namespace turnscan::python
