#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace turnscan {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// Pixels row by row, from the top left.
template <class T>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<T> pixels;  ///< width * height

  Image() = default;
  Image(int w, int h, T value = T())
      : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), value) {}

  bool empty() const { return pixels.empty(); }
  T& at(int column, int row) { return pixels[std::size_t(row) * width + column]; }
  const T& at(int column, int row) const { return pixels[std::size_t(row) * width + column]; }
};

using ColorImage = Image<Rgb>;

/// Raw depth in units of the sensor's depth_unit_m, measured along z.
using DepthImage = Image<std::uint16_t>;
inline constexpr std::uint16_t kNoReturn = 0;         ///< the sensor saw nothing there
inline constexpr std::uint16_t kOutsideCrop = 65535;  ///< a return outside the crop: seen empty

}  // namespace turnscan
