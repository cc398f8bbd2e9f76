#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {
namespace {

std::size_t sample(const Volume& volume, int i, int j, int k) {
  const auto slot = std::size_t(volume.slot[volume.bricks.at({i / 8, j / 8, k / 8})]);
  return slot * 512 + std::size_t(i % 8 + 8 * (j % 8) + 64 * (k % 8));
}

/// A cube of bricks without samples, cells of 1 m.
Volume empty_volume(int bricks) {
  Volume volume;
  volume.cell_m = 1.0;
  volume.truncation_m = 3.0;
  volume.set_bricks({bricks, bricks, bricks});
  return volume;
}

constexpr int kBallBricks = 6, kHalf = 4 * kBallBricks;

/// Where the surface lies on the +x axis of a ball of 15 cells of which a cap towards +x, 35
/// degrees wide, was never seen, nor what lies before it. Distances are known `inside` cells deep.
double cap_height(double inside) {
  Volume volume = empty_volume(kBallBricks);
  volume.origin_m = Vec3d::Constant(-kHalf);
  for (std::size_t b = 0; b < volume.slot.size(); ++b) volume.allocate(b, 0.0f);
  for (int k = 0; k < 2 * kHalf; ++k) {
    for (int j = 0; j < 2 * kHalf; ++j) {
      for (int i = 0; i < 2 * kHalf; ++i) {
        const Vec3d p = volume.position(i, j, k);
        const double d = p.norm() - 15.0;
        const bool cap = p.x() > std::cos(35.0 * std::numbers::pi / 180.0) * p.norm();
        if (cap || d < -inside) continue;
        volume.value[sample(volume, i, j, k)] = float(std::min(d, 3.0));
        volume.weight[sample(volume, i, j, k)] = 1.0f;
      }
    }
  }
  VolumeScale scale;
  scale.cell_m = 1.0, scale.truncation_m = 3.0;
  EXPECT_TRUE(close_holes(volume, scale, Foot(), RunContext()));
  int i = kHalf;
  while (i + 1 < 2 * kHalf && volume.value[sample(volume, i, kHalf, kHalf)] < 0.0f) ++i;
  return volume.position(i, 0, 0).x() - 0.5;
}

TEST(CloseHoles, WhatWasNotSeenNeitherSinksInNorBulges) {
  const double flat = 15.0 * std::cos(35.0 * std::numbers::pi / 180.0);
  for (const double inside : {1.0, 2.0, 3.0}) {
    EXPECT_GT(cap_height(inside), flat - 2.0) << inside;
    EXPECT_LT(cap_height(inside), 16.5) << inside;
  }
}

TEST(CloseHoles, WhatNoPassSawEndsFlatOnALeaningPlatter) {
  Volume volume = empty_volume(kBallBricks);
  volume.origin_m = Vec3d::Constant(-kHalf);
  VolumeScale scale;
  scale.cell_m = 1.0, scale.truncation_m = 3.0;
  scale.platters = {{Vec3d(0.36, 0.8, 0.48), -6.0}};
  // A ball of 15 cells around the origin, cut by the platter; the lowest 4 cells above it were not
  // seen. Distances are known 3 cells deep; far bricks have no samples.
  const auto known = [&](const Vec3d& p) {
    return scale.platters[0].above(p) > 4.0 && p.norm() - 15.0 > -3.0;
  };
  for (std::size_t b = 0; b < volume.slot.size(); ++b) {
    const GridCoords at = volume.bricks.coords(b);
    bool any = false, free = true;
    for (std::size_t s = 0; s < 512; ++s) {
      const Vec3d p = volume.position(8 * at[0] + int(s % 8), 8 * at[1] + int(s / 8 % 8),
                                      8 * at[2] + int(s / 64));
      any |= known(p) && p.norm() < 18.0;
      free &= known(p) && p.norm() >= 18.0;
    }
    volume.uniform[b] = free ? 1.0f : 0.0f;
    if (!any) continue;
    volume.allocate(b, 3.0f);
    for (std::size_t s = 0; s < 512; ++s) {
      const Vec3d p = volume.position(8 * at[0] + int(s % 8), 8 * at[1] + int(s / 8 % 8),
                                      8 * at[2] + int(s / 64));
      if (!known(p)) continue;
      volume.value[volume.first_sample(b) + s] = float(std::min(p.norm() - 15.0, 3.0));
      volume.weight[volume.first_sample(b) + s] = 1.0f;
    }
  }
  ASSERT_TRUE(close_holes(volume, scale, Foot(), RunContext()));
  for (int k = 0; k < 2 * kHalf; ++k) {
    for (int j = 0; j < 2 * kHalf; ++j) {
      for (int i = 0; i < 2 * kHalf; ++i) {
        const Vec3d p = volume.position(i, j, k);
        const std::size_t b = volume.bricks.at({i / 8, j / 8, k / 8});
        const float value =
            volume.slot[b] < 0 ? 3.0f * volume.uniform[b] : volume.value[sample(volume, i, j, k)];
        const double above = scale.platters[0].above(p);
        if (above < 0.0) {
          EXPECT_GE(value, 0.0f) << p.transpose();
        }
        // Walls go on down, within a cell or two.
        if (above > 0.5 && p.norm() < 12.0) {
          EXPECT_LT(value, 0.0f) << p.transpose();
        }
        if (above > 0.5 && p.norm() > 19.0) {
          EXPECT_GT(value, 0.0f) << p.transpose();
        }
      }
    }
  }
}

TEST(CloseHoles, StopsWhenItIsCancelled) {
  Volume volume = empty_volume(3);
  for (std::size_t b = 0; b < volume.slot.size(); ++b) volume.allocate(b, 0.0f);
  std::fill(volume.weight.begin() + 4096, volume.weight.end(), 1.0f);
  const VolumeScale scale;
  RunContext before;
  before.cancel();
  EXPECT_EQ(close_holes(volume, scale, Foot(), before).error().code, ErrorCode::kCancelled);
  RunContext within;  // after its phase began
  within.set_listener([&](const Progress& progress) {
    if (progress.phase == "closing") within.cancel();
  });
  EXPECT_EQ(close_holes(volume, scale, Foot(), within).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::tsdf
