#include <gtest/gtest.h>

#include <turnscan/reconstruction/views/depth_window.hpp>

namespace turnscan::views {
namespace {

TEST(DepthView, PacksDepthEdgeAndFreeSpace) {
  const std::uint32_t word = DepthView::pack(9001, true, 8000);
  EXPECT_EQ(word & 0xffffu, 9001u);
  EXPECT_NE(word & DepthView::kEdge, 0u);
  EXPECT_EQ(word >> 17 << 1, 8000u);
}

TEST(DepthView, SeesPastNothingThatANeighbourTwoPixelsAwaySaw) {
  RawWindow raw(9, 9);
  for (auto& depth : raw.pixels) depth = kOutsideCrop;
  raw.at(4, 4) = 9000;
  raw.at(0, 0) = kNoReturn;
  DepthView view;
  pack_window(raw, 0.01, view);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const std::uint32_t free = view.pixels[std::size_t(11 * (y + 1) + x + 1)] >> 17 << 1;
      const bool near = std::abs(x - 4) <= 2 && std::abs(y - 4) <= 2;
      EXPECT_EQ(free, x + y == 0 ? 0u : near ? 9000u : 65534u) << x << " " << y;
    }
  }
}

std::uint32_t depth_at(const DepthView& view, int x, int y) {
  return view.pixels[std::size_t(view.width * (y + 1) + x + 1)] & 0xffffu;
}

TEST(DepthView, AMixtureBehindARimIsNoMeasurement) {
  RawWindow raw(9, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 9; ++x) raw.at(x, y) = x < 4 ? 8500 : x == 4 ? 8700 : 9000;
  }
  DepthView view;
  pack_window(raw, 0.01, view);
  for (int x = 0; x < 9; ++x) EXPECT_EQ(depth_at(view, x, 2), x == 4 ? 0u : raw.at(x, 2)) << x;
  // It saw free space all the same.
  EXPECT_NE(view.pixels[std::size_t(11 * 3 + 5)] >> 17, 0u);
}

TEST(DepthView, ASteepSlopeIsMeasured) {
  RawWindow raw(9, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 9; ++x) raw.at(x, y) = std::uint16_t(8500 + 150 * x);
  }
  DepthView view;
  pack_window(raw, 0.01, view);
  for (int x = 2; x < 9; ++x) EXPECT_EQ(depth_at(view, x, 2), raw.at(x, 2)) << x;
}

}  // namespace
}  // namespace turnscan::views
