#include <gtest/gtest.h>

#include <numeric>
#include <turnscan/reconstruction/views/depth_window.hpp>
#include <turnscan/reconstruction/views/no_return.hpp>

namespace turnscan::views {
namespace {

constexpr int kSize = 24;

/// A figure of 8 columns before a wall, with a band of rows in which nothing returns, and rims of
/// some pixels on either side. Depths in 0.1 mm.
DepthView figure(std::uint16_t wall, int rim, int band) {
  RawWindow raw(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int outside = std::max(8 - x, x - 15);
      std::uint16_t depth = outside <= 0 ? 8000 : outside <= rim ? kNoReturn : wall;
      if (outside <= 0 && y >= 10 && y < 10 + band) depth = kNoReturn;
      raw.at(x, y) = y < 3 ? wall : depth;
    }
  }
  DepthView view;
  pack_window(raw, 0.01, view);
  return view;
}

int count(const Image<std::uint8_t>& mask) {
  return std::accumulate(mask.pixels.begin(), mask.pixels.end(), 0);
}

TEST(NoReturn, ABandBeforeAWallIsEnclosed) {
  const auto mask = enclosed_no_return(figure(16000, 0, 5));
  EXPECT_EQ(count(mask), 8 * 5);
  EXPECT_EQ(mask.at(1 + 8, 1 + 10), 1);
  EXPECT_EQ(mask.at(1 + 15, 1 + 14), 1);
}

TEST(NoReturn, WhereTheBackgroundReturnsNothingNothingIsKnown) {
  EXPECT_TRUE(enclosed_no_return(figure(kNoReturn, 0, 5)).empty());
}

TEST(NoReturn, RimsAndGapsOfTwoPixelsAreLeftOut) {
  EXPECT_TRUE(enclosed_no_return(figure(16000, 2, 2)).empty());
  EXPECT_GE(count(enclosed_no_return(figure(16000, 2, 5))), 8 * 5);
}

TEST(NoReturn, RimsAreAsWideAsWhatIsMissing) {
  for (const std::uint16_t wall : {std::uint16_t(16000), kOutsideCrop}) {
    for (const int rim : {3, 5}) {
      const auto widths = rim_widths(figure(wall, rim, 0));
      EXPECT_EQ(widths.size(), 2u * (kSize - 3));
      for (const int width : widths) EXPECT_EQ(width, rim);
    }
  }
}

}  // namespace
}  // namespace turnscan::views
