#pragma once
// Conversion between sRGB (IEC 61966-2-1) and linear light. Colours in memory and in most files are
// sRGB; glTF's COLOR_0 is linear.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace turnscan::mesh_io {

/// 8-bit sRGB to linear light in [0, 1].
inline double linear_from_srgb(std::uint8_t value) {
  const double s = value / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// The inverse; values outside [0, 1] are clamped, NaN becomes 0.
inline std::uint8_t srgb_from_linear(double value) {
  if (!(value > 0.0)) return 0;
  const double v = std::min(value, 1.0);
  const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(s * 255.0 + 0.5);
}

}  // namespace turnscan::mesh_io
