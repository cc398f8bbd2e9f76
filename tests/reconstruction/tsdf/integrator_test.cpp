#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/core/pose.hpp>
#include <turnscan/reconstruction/tsdf/integrator.hpp>

namespace turnscan::tsdf {
namespace {

/// A wall at z = 0.5 m as a camera sees it, 60 x 60 pixels, `turn` about the table's axis; a block
/// in front of it, 50 mm wide, at `block` m to the right.
views::DepthView wall(double turn, double block) {
  views::DepthView view;
  const Pose pose = rotation_about_y(turn);
  view.rotation = pose.linear().cast<float>();
  view.translation = Vec3f(0, 0, 0.5f);
  view.fx = view.fy = 100.0f;
  view.cx = view.cy = 29.5f;
  view.width = view.height = 60;
  view.pixels.resize(3600);
  view.nearest = 4500;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double at = (x - 29.5) / 100.0 * 0.45;
      const auto raw = std::uint16_t(std::abs(at - block) < 0.025 ? 4500 : 5000);
      view.pixels[std::size_t(60 * y + x)] = views::DepthView::pack(raw, false, raw);
    }
  }
  return view;
}

VolumeScale volume_scale() {
  VolumeScale out;
  out.cell_m = 0.004;
  out.truncation_m = 0.012;
  out.full_weight_behind_m = 0.008;
  return out;
}

std::vector<views::DepthView> walls() {
  std::vector<views::DepthView> views;
  for (int v = 0; v < 12; ++v) views.push_back(wall(0.03 * v, 0.008 * v - 0.04));
  return views;
}

const Box kBox = [] {
  Box box;
  box.add(Vec3d(-0.1, -0.1, -0.1));
  box.add(Vec3d(0.1, 0.1, 0.1));
  return box;
}();

TEST(Integrator, KnowsWhatEarlierViewsSawOfBricksThatComeLate) {
  const std::vector<views::DepthView> views = walls();
  Integrator at_once(volume_scale()), one_by_one(volume_scale());
  ASSERT_TRUE(at_once.integrate(views, {}));
  const std::span<const views::DepthView> all(views);
  for (std::size_t v = 0; v < all.size(); ++v)
    ASSERT_TRUE(one_by_one.integrate(all.subspan(v, 1), {all.first(v), 1.0f}));
  const Volume a = *at_once.extract_volume(kBox), b = *one_by_one.extract_volume(kBox);
  ASSERT_EQ(a.slot, b.slot);
  EXPECT_EQ(a.uniform, b.uniform);
  ASSERT_GT(a.value.size(), 10000u);
  for (std::size_t s = 0; s < a.value.size(); ++s) {
    ASSERT_NEAR(a.value[s], b.value[s], 1e-6) << s;
    ASSERT_NEAR(a.weight[s], b.weight[s], 1e-4) << s;
  }
}

TEST(Integrator, AViewCountsAsManyTimesAsItStandsFor) {
  const std::vector<views::DepthView> views{wall(0, 0), wall(0, 0), wall(0, 0), wall(0, 0),
                                            wall(0, 0.04)};
  const std::span<const views::DepthView> all(views);
  Integrator every(volume_scale()), half(volume_scale());
  ASSERT_TRUE(every.integrate(all.first(4), {}));
  ASSERT_TRUE(every.integrate(all.last(1), {all.first(4), 1.0f}));
  ASSERT_TRUE(half.integrate(all.first(4), {}));
  ASSERT_TRUE(half.integrate(all.last(1), {all.first(2), 2.0f}));
  EXPECT_EQ(every.extract_volume(kBox)->value, half.extract_volume(kBox)->value);
}

/// Without what is right of the middle: hidden, say.
views::DepthView left_half(views::DepthView view) {
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (i % 60 >= 30) view.pixels[i] = 0;
  }
  return view;
}

/// Of the samples of bricks right of the middle.
struct KnownSamples {
  std::size_t free = 0, at_surface = 0;
};

/// Of a wall whose right half only some of the views saw.
KnownSamples known_on_the_right(std::size_t saw_it, std::size_t others) {
  std::vector<views::DepthView> views(others, left_half(wall(0, 1.0)));
  views.resize(others + saw_it, wall(0, 1.0));
  Integrator integrator(volume_scale());
  EXPECT_TRUE(integrator.integrate(views, {}));
  const Volume volume = *integrator.extract_volume(kBox);
  KnownSamples out;
  for (const std::size_t b : volume.allocated_bricks()) {
    for (std::size_t s = 0; s < kBrickSamples; ++s) {
      const std::size_t sample = volume.first_sample(b) + s;
      const GridCoords at = volume.bricks.coords(b);
      const double x = volume.position(at[0] * kBrickSide + int(s & 7), 0, 0).x();
      if (x <= 0.02 || volume.weight[sample] <= 0.0f) continue;
      ++(volume.value[sample] > 0.99f * float(volume.truncation_m) ? out.free : out.at_surface);
    }
  }
  return out;
}

TEST(Integrator, WhatThreeViewsSawIsKnownHoweverManySawOtherPlaces) {
  const KnownSamples alone = known_on_the_right(3, 0), among_others = known_on_the_right(3, 400);
  EXPECT_GT(alone.free, 300u);
  EXPECT_GT(alone.at_surface, 1000u);
  EXPECT_EQ(among_others.free, alone.free);
  EXPECT_EQ(among_others.at_surface, alone.at_surface);
}

TEST(Integrator, WhatTwoOfAThousandViewsMeasuredIsNoSurface) {
  const KnownSamples alone = known_on_the_right(2, 0), among_others = known_on_the_right(2, 998);
  EXPECT_GT(alone.at_surface, 1000u);
  EXPECT_EQ(among_others.at_surface, 0u);
  EXPECT_EQ(among_others.free, alone.free);  // but what they saw past is free
}

TEST(Integrator, IsCoarseWhereFewBricksAreAllowed) {
  Integrator integrator(volume_scale());
  ASSERT_TRUE(integrator.integrate(walls(), {}));
  const Volume fine = integrator.extract_coarse_volume(100000),
               coarse = integrator.extract_coarse_volume(8);
  EXPECT_DOUBLE_EQ(fine.cell_m, 0.008);
  EXPECT_LE(coarse.brick_count(), 8u);
  // The wall at z = 0 seen by the first view: negative behind, positive in front.
  const auto value = [&](const Vec3d& p) {
    const Vec3d at = (p - fine.origin_m) / fine.cell_m;
    const GridCoords brick{int(at.x()) / 8, int(at.y()) / 8, int(at.z()) / 8};
    const std::int32_t slot = fine.slot[fine.bricks.at(brick)];
    return slot < 0
               ? 0.0f
               : fine.value[std::size_t(slot) * 512 + std::size_t(int(at.x()) % 8) +
                            std::size_t(int(at.y()) % 8) * 8 + std::size_t(int(at.z()) % 8) * 64];
  };
  EXPECT_LT(value({-0.09, 0.0, 0.008}), 0.0f);
  EXPECT_GT(value({-0.09, 0.0, -0.012}), 0.0f);
}

TEST(Integrator, RefusesMoreThanItsMemory) {
  VolumeScale small = volume_scale();
  small.max_bytes = 1 << 20;
  Integrator integrator(small);
  EXPECT_EQ(integrator.integrate(walls(), {}).error().code, ErrorCode::kResourceLimit);
  VolumeScale fine = volume_scale();
  fine.cell_m = 1e-5;
  Integrator many(fine);
  EXPECT_EQ(many.integrate(walls(), {}).error().code, ErrorCode::kResourceLimit);
}

}  // namespace
}  // namespace turnscan::tsdf
