#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/turntable/motion_input/depth_preprocessing.hpp>

namespace turnscan::motion {
namespace {

constexpr int kSize = 61;
constexpr double kFx = 366.0, kDistance_m = 0.9, kRadius_m = 0.06;

/// A ball as a camera sees it; 0 beside it.
std::vector<float> ball() {
  std::vector<float> out(kSize * kSize, 0.0f);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double a = (x - kSize / 2) / kFx, b = (y - kSize / 2) / kFx;
      // Of |t (a, b, 1) - (0, 0, d)| = r the nearer solution.
      const double square = a * a + b * b + 1.0;
      const double root =
          kDistance_m * kDistance_m - square * (kDistance_m * kDistance_m - kRadius_m * kRadius_m);
      if (root > 0.0)
        out[std::size_t(y * kSize + x)] = float((kDistance_m - std::sqrt(root)) / square);
    }
  }
  return out;
}

/// The mean over 3 x 3 pixels, where all of them see the ball.
std::vector<float> filtered(const std::vector<float>& z) {
  std::vector<float> out(z.size(), 0.0f);
  for (int y = 1; y + 1 < kSize; ++y) {
    for (int x = 1; x + 1 < kSize; ++x) {
      float sum = 0.0f;
      bool whole = true;
      for (int k = 0; k < 9; ++k) {
        const float there = z[std::size_t((y + k / 3 - 1) * kSize + x + k % 3 - 1)];
        whole = whole && there > 0.0f;
        sum += there / 9.0f;
      }
      if (whole) out[std::size_t(y * kSize + x)] = sum;
    }
  }
  return out;
}

TEST(CorrectFilterSag, PutsABallThatTheSensorAveragedBackWhereItWas) {
  const std::vector<float> truth = ball();
  DepthForeground depth;
  depth.surface.width = depth.surface.height = kSize;
  depth.surface.z = filtered(truth);
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (depth.surface.z[i] > 0.0f) depth.pixels.push_back(std::int32_t(i));
  const std::vector<float> before = depth.surface.z;
  correct_filter_sag(depth, kFx, 0.001);
  // Where the window of 5 x 5 pixels is whole.
  double off_before = 0.0, off_after = 0.0, count = 0.0;
  for (int y = kSize / 2 - 12; y <= kSize / 2 + 12; ++y) {
    for (int x = kSize / 2 - 12; x <= kSize / 2 + 12; ++x) {
      const auto i = std::size_t(y * kSize + x);
      off_before += before[i] - truth[i], off_after += depth.surface.z[i] - truth[i], ++count;
    }
  }
  EXPECT_GT(off_before / count, 5e-5);
  EXPECT_LT(std::abs(off_after), 0.1 * off_before);
}

}  // namespace
}  // namespace turnscan::motion
