#pragma once
// sRGB (IEC 61966-2-1) as floats.

#include <cmath>

namespace turnscan::texture {

/// Converts 0 to 255 to linear light in [0, 1], and extrapolates beyond it.
inline float linear_of(float srgb) {
  const float s = srgb / 255.0f;
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

/// The inverse; negative values become 0.
inline float srgb_of(float linear) {
  if (!(linear > 0.0f)) return 0.0f;
  const float s =
      linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
  return 255.0f * s;
}

}  // namespace turnscan::texture
