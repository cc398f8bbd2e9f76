#pragma once
// What the Kinect of stand_in.cpp shows.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace turnscan::testing::pattern {

inline constexpr int kWidth = 640, kHeight = 480;
inline constexpr std::size_t kPixels = std::size_t(kWidth) * std::size_t(kHeight);
inline constexpr std::uint32_t kFrames = 4;
/// A variable of the environment: when it is set, no depth is registered to colours.
inline constexpr const char* kUnregistered = "TURNSCAN_TEST_UNREGISTERED";

/// Millimetres; every seventh pixel without a return, some beyond what the sensor can measure.
inline std::vector<std::uint16_t> depth_mm(std::uint32_t frame) {
  std::vector<std::uint16_t> out(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i)
    out[i] = static_cast<std::uint16_t>(i % 7 == 0 ? 0 : 600 + (i * 31 + frame * 17) % 9500);
  return out;
}

inline std::vector<std::uint8_t> colors(std::uint32_t frame) {
  std::vector<std::uint8_t> out(3 * kPixels);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<std::uint8_t>((i * 13 + frame * 41) >> 3);
  return out;
}

}  // namespace turnscan::testing::pattern
