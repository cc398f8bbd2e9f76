#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>

#include "tests/reconstruction/tsdf/volume_on_platter.hpp"

namespace turnscan::tsdf {
namespace {

using testing::kFloor;

/// 32 mm high; all is known but what is below the floor.
template <class Distance>
Volume known_above_floor(const Distance& distance) {
  return testing::volume_on_platter(4, distance, [](const Vec3d&) { return true; });
}

double upright(const Vec3d& p) { return std::hypot(p.x(), p.z()) - 0.012; }
double resting_ball(const Vec3d& p) { return (p - Vec3d(0, 0.015, 0)).norm() - 0.015; }
double widening(const Vec3d& p) { return 0.8 * (std::hypot(p.x(), p.z()) - 0.018 + 0.7 * p.y()); }

TEST(TaperedFoot, AreWhereABallRests) {
  const TaperedFoot round(known_above_floor(resting_ball), kFloor);
  EXPECT_FALSE(round.none());
  EXPECT_TRUE(round.contains(Vec3f(0.0f, 0.0f, 0.0f)));
  EXPECT_TRUE(round.contains(Vec3f(0.008f, 0.0f, 0.004f)));
  EXPECT_FALSE(round.contains(Vec3f(0.1f, 0.0f, 0.0f)));
}

/// How far the inside reaches beyond a ball that rests on the platter, once holes are closed.
double plinth_of_ball(bool round) {
  Volume volume = known_above_floor(resting_ball);
  VolumeScale scale;
  scale.cell_m = volume.cell_m;
  scale.truncation_m = volume.truncation_m;
  scale.floor_m = 0.004;
  const Foot foot{round ? TaperedFoot(volume, kFloor) : TaperedFoot(), {}};
  EXPECT_TRUE(close_holes(volume, scale, foot, RunContext()));
  double out = 0.0;
  const VolumeSamples samples(volume);
  for (int k = 0; k < samples.size()[2]; ++k)
    for (int j = 0; j < samples.size()[1]; ++j)
      for (int i = 0; i < samples.size()[0]; ++i)
        if (samples.value(i, j, k) < 0.0f)
          out = std::max(out, resting_ball(volume.position(i, j, k)));
  return out;
}

TEST(TaperedFoot, GetNoPlinth) {
  EXPECT_GT(plinth_of_ball(false), 0.0025);
  EXPECT_LT(plinth_of_ball(true), 0.0015);
}

TEST(TaperedFoot, AreNotUnderUprightAndWideningWalls) {
  EXPECT_TRUE(TaperedFoot(known_above_floor(upright), kFloor).none());
  EXPECT_TRUE(TaperedFoot(known_above_floor(widening), kFloor).none());
  EXPECT_TRUE(TaperedFoot().none());
  EXPECT_FALSE(TaperedFoot().contains(Vec3f::Zero()));
}

TEST(TaperedFoot, OfTwoThingsOnlyTheRoundOneHasOne) {
  const auto both = [](const Vec3d& p) {
    return std::min((p - Vec3d(-0.012, 0.010, 0)).norm() - 0.010,
                    std::hypot(p.x() - 0.014, p.z()) - 0.006);
  };
  const TaperedFoot round(known_above_floor(both), kFloor);
  EXPECT_TRUE(round.contains(Vec3f(-0.012f, 0.0f, 0.0f)));
  EXPECT_FALSE(round.contains(Vec3f(0.014f, 0.0f, 0.0f)));
}

TEST(TaperedFoot, WhatWasNotSeenTellsNothing) {
  Volume volume = known_above_floor(resting_ball);
  std::fill(volume.weight.begin(), volume.weight.end(), 0.0f);
  EXPECT_TRUE(TaperedFoot(volume, kFloor).none());
}

}  // namespace
}  // namespace turnscan::tsdf
