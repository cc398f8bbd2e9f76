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

TEST(DepthView, InAGapOfOneOrTwoPixelsNothingIsMeasured) {
  for (int wide = 1; wide <= 3; ++wide) {
    for (const bool upright : {true, false}) {
      RawWindow raw(9, 9);
      const auto in_gap = [&](int x, int y) {
        const int along = upright ? x : y;
        return along >= 4 && along < 4 + wide;
      };
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x)
          raw.at(x, y) = in_gap(x, y) ? 8900 : (upright ? x : y) < 4 ? 8500 : 8600;
      }
      DepthView view;
      pack_window(raw, 0.01, view);
      // The bottom of a wider one is, away from the image's border, beyond which all may lie.
      for (int y = 1; y < 8; ++y) {
        for (int x = 1; x < 8; ++x)
          EXPECT_EQ(depth_at(view, x, y), in_gap(x, y) && wide < 3 ? 0u : raw.at(x, y))
              << x << " " << y << " of " << wide;
      }
    }
  }
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

/// A camera that looks down from 1 m at a patch 0.2 m high, of a recording that a crop blackened
/// around it; one pixel shows something under the patch that the crop does not keep now.
Frame cropped_frame(SensorInfo& sensor) {
  sensor.intrinsics.width = sensor.intrinsics.height = 32;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 64.0;
  sensor.intrinsics.cx = sensor.intrinsics.cy = 15.5;
  Frame frame;
  frame.depth = DepthImage(32, 32);
  for (auto& depth : frame.depth.pixels) depth = kOutsideCrop;
  for (int y = 14; y < 18; ++y) {
    for (int x = 14; x < 18; ++x) frame.depth.at(x, y) = 8000;
  }
  frame.depth.at(20, 16) = 9900;
  return frame;
}

TEST(DepthView, OfSeveralPassesWhatItsTableCropsOnlyBoundsFreeSpace) {
  SensorInfo sensor;
  const Frame frame = cropped_frame(sensor);
  const RayTable rays(sensor.intrinsics);
  const auto keep = [](const Vec3f& p) { return p.z() < 0.98f; };
  ViewScale scale;
  const DepthView alone = *make_view(frame, sensor, rays, Pose::Identity(), scale, keep);
  scale.only_kept = true;
  scale.seen_above = Eigen::Vector4f(0.0f, 0.0f, -1.0f, 0.98f);
  const DepthView view = *make_view(frame, sensor, rays, Pose::Identity(), scale, keep);
  ASSERT_EQ(view.width, alone.width);
  std::size_t dropped = 0, ended = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const std::uint32_t before = alone.pixels[i], after = view.pixels[i];
    const std::uint32_t free = before >> 17 << 1;
    EXPECT_EQ(after & 0xffffu, (before & 0xffffu) == 9900u ? 0u : before & 0xffffu);
    dropped += (before & 0xffffu) == 9900u ? 1 : 0;
    // What was measured bounds free space as before; what was cropped ends at the crop.
    EXPECT_NEAR(after >> 17 << 1, free == 65534u ? 9800u : free, 2u);
    ended += free == 65534u ? 1 : 0;
  }
  EXPECT_EQ(dropped, 1u);
  EXPECT_GT(ended, 10u);
}

TEST(DepthViews, AreFewerForStatisticsTheMorePixelsTheyHave) {
  std::vector<DepthView> views(60);
  const auto with_pixels = [&](std::size_t pixels) {
    for (DepthView& view : views) view.pixels.resize(pixels);
    return views_for_statistics(views, 24);
  };
  EXPECT_EQ(with_pixels(0), 24u);
  EXPECT_EQ(with_pixels(1000), 24u);
  EXPECT_EQ(with_pixels(400'000), 10u);
  EXPECT_EQ(with_pixels(6'000'000), 4u) << "one or two views show too little of an object";
  EXPECT_EQ(views_for_statistics(std::span(views).first(3), 24), 3u);
  EXPECT_EQ(views_for_statistics(std::span(views).first(0), 24), 0u);
}

}  // namespace
}  // namespace turnscan::views
