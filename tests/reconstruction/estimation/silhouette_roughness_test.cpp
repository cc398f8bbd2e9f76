#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/estimation/silhouette_roughness.hpp>
#include <turnscan/reconstruction/views/view_drawing.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan::estimation {
namespace {

constexpr int kWidth = 80, kHeight = 60;

/// From half a metre, pixels of 2 mm there.
views::DepthView camera() {
  views::DepthView view;
  view.translation = Vec3f(0.0f, 0.0f, 0.5f);
  view.fx = view.fy = 250.0f;
  view.cx = 0.5f * float(kWidth);
  view.cy = 0.5f * float(kHeight);
  view.width = kWidth;
  view.height = kHeight;
  view.pixels.assign(std::size_t(kWidth * kHeight), 0);
  return view;
}

/// As pixels see it that look lateral_px beside their places, and noise_m too far.
std::vector<views::DepthView> views_of(const TriangleMesh& mesh, double lateral_px,
                                       double noise_m) {
  std::vector<views::DepthView> views;
  for (int v = 0; v < 6; ++v) {
    views::DepthView view = camera();
    const views::ViewDrawing drawing(view, mesh);
    for (int y = 4; y < kHeight - 4; ++y)
      for (int x = 4; x < kWidth - 4; ++x) {
        const auto deviate = [&](std::uint64_t what) {
          return standard_normal(
              hash_key(what, std::uint64_t(v), std::uint64_t(x), std::uint64_t(y)));
        };
        const auto seen = drawing.received(x + int(std::lround(lateral_px * deviate(1))),
                                           y + int(std::lround(lateral_px * deviate(2))));
        if (!(seen.light > 0.0f)) continue;
        const double z = double(seen.mean()) + noise_m * deviate(3);
        view.pixels[std::size_t(y * kWidth + x)] =
            views::DepthView::pack(std::uint32_t(std::lround(z * 1e4)), false, 0);
      }
    views.push_back(std::move(view));
  }
  return views;
}

const TriangleMesh kBall = test::sphere(0.04, 5);

TEST(RaggedOutlines, AreThoseOfPixelsThatSeePlacesBesideTheirs) {
  const double sharp = ragged_share(views_of(kBall, 0.0, 0.0015), kBall, 0.0015);
  const double slightly = ragged_share(views_of(kBall, 0.4, 0.0015), kBall, 0.0015);
  const double much = ragged_share(views_of(kBall, 0.8, 0.0015), kBall, 0.0015);
  EXPECT_EQ(sharp, 0.0);
  EXPECT_GT(slightly, 0.02);
  EXPECT_GT(much, slightly + 0.05);
  EXPECT_LT(much, 0.5);
}

TEST(RaggedOutlines, AreNotThoseOfWhatLiesFarBehind) {
  auto views = views_of(kBall, 0.0, 0.0);
  for (views::DepthView& view : views)
    for (std::uint32_t& pixel : view.pixels)
      if (pixel == 0) pixel = views::DepthView::pack(6500, false, 0);  // a wall
  EXPECT_EQ(ragged_share(views, kBall, 0.0015), 0.0);
}

TEST(RaggedOutlines, AreUnknownWithoutEnoughOutlines) {
  const auto views = views_of(kBall, 0.8, 0.0015);
  EXPECT_EQ(ragged_share({}, kBall, 0.0015), 0.0);
  EXPECT_EQ(ragged_share(views, TriangleMesh(), 0.0015), 0.0);
  EXPECT_EQ(ragged_share({views.data(), 1}, test::sphere(0.004, 3), 0.0015), 0.0);
}

TEST(RaggedOutlines, AreTheSameForAnyNumberOfThreads) {
  const auto views = views_of(kBall, 0.6, 0.0015);
  const double two = ragged_share(views, kBall, 0.0015);
  set_thread_count(1);
  const double one = ragged_share(views, kBall, 0.0015);
  set_thread_count(0);
  EXPECT_EQ(one, two);
}

}  // namespace
}  // namespace turnscan::estimation
