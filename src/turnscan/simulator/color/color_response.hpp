#pragma once
// sRGB and noise of millions of pixels from lookup tables, since powers and logarithms would
// dominate the time of an image.

#include <algorithm>
#include <array>
#include <cstdint>
#include <turnscan/core/pose.hpp>

namespace turnscan::sampling {

/// IEC 61966-2-1, accurate to a hundredth of a level.
class SrgbCurve {
 public:
  static const SrgbCurve& instance();

  /// 0 to 255 to light in [0, 1]. Precondition: within this range.
  float linear(float srgb) const {
    const float at = srgb * kStepsPerLevel;
    const int i = std::min(int(at), kLevels - 1);
    return between(&linear_[std::size_t(i)], at - float(i));
  }
  Vec3f linear(const Vec3f& srgb) const {
    return {linear(srgb.x()), linear(srgb.y()), linear(srgb.z())};
  }
  /// The inverse; negative light gives 0, and light above 1 continues above 255.
  float srgb(float linear) const {
    if (!(linear > 0.0f)) return 0.0f;
    if (linear >= 1.0f) return beyond(linear);
    const float at = linear * kLights;
    const int i = int(at);
    return between(&srgb_[std::size_t(i)], at - float(i));
  }

 private:
  static constexpr int kStepsPerLevel = 4, kLevels = 255 * kStepsPerLevel, kLights = 4096;
  SrgbCurve();
  static float between(const float* pair, float share) {
    return pair[0] + share * (pair[1] - pair[0]);
  }
  static float beyond(float linear);
  std::array<float, std::size_t(kLevels) + 1> linear_;
  std::array<float, std::size_t(kLights) + 1> srgb_;
};

/// Normally distributed: 4096 equally likely values, sufficient for noise that is rounded to levels
/// of an image.
class NoiseTable {
 public:
  static const NoiseTable& instance();
  /// Selects a value by the lowest 12 bits.
  float operator()(std::uint64_t bits) const { return values_[bits & (kValues - 1)]; }
  static constexpr int kBits = 12;

 private:
  static constexpr std::size_t kValues = std::size_t(1) << kBits;
  NoiseTable();
  std::array<float, kValues> values_;
};

}  // namespace turnscan::sampling
