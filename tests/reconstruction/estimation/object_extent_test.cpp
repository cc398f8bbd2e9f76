#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/estimation/object_extent.hpp>

namespace turnscan::estimation {
namespace {

constexpr double kCell_m = 0.008;
const Cylinder kPlatter{0.003, 2.0, 0.1};

/// Points 2 mm apart on the upper side of a bar along x, 30 mm wide, 50 mm above the platter.
std::vector<Vec3f> bar(double from_x, double to_x) {
  std::vector<Vec3f> points;
  for (double x = from_x; x < to_x; x += 0.002)
    for (double z = -0.015; z < 0.015; z += 0.002) points.emplace_back(x, 0.05, z);
  return points;
}

void add(std::vector<Vec3f>& points, const std::vector<Vec3f>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

TEST(ReachBeyond, IsHowFarAWiderObjectReaches) {
  const auto reach = reach_beyond(bar(-0.08, 0.17), kPlatter, kCell_m);
  ASSERT_TRUE(reach);
  EXPECT_NEAR(*reach, 0.17, 0.003);
}

TEST(ReachBeyond, IsNoneOfAnObjectOnThePlatter) {
  EXPECT_FALSE(reach_beyond(bar(-0.08, 0.098), kPlatter, kCell_m));
  EXPECT_FALSE(reach_beyond({}, kPlatter, kCell_m));
}

TEST(ReachBeyond, WhatStandsApartDoesNotCount) {
  std::vector<Vec3f> points = bar(-0.08, 0.08);
  add(points, bar(0.12, 0.25));
  EXPECT_FALSE(reach_beyond(points, kPlatter, kCell_m));
}

TEST(ReachBeyond, PixelsMixedWithTheBackgroundDoNotLeadToIt) {
  std::vector<Vec3f> points = bar(-0.08, 0.08);
  add(points, bar(0.16, 0.25));
  for (std::uint64_t i = 0; i < 60; ++i)  // between them, about one in two cells
    points.emplace_back(0.08 + 0.08 * uniform01(hash_key(1, i, 0)), 0.05,
                        -0.015 + 0.03 * uniform01(hash_key(1, i, 1)));
  EXPECT_FALSE(reach_beyond(points, kPlatter, kCell_m));
}

TEST(ReachBeyond, WhatSurroundsThePlatterDoesNotCount) {
  std::vector<Vec3f> points = bar(-0.08, 0.08);
  for (double x = -0.25; x < 0.25; x += 0.002)
    for (double z = -0.25; z < 0.25; z += 0.002) points.emplace_back(x, 0.004, z);
  for (double y = 0.0; y < 0.05; y += 0.002) points.emplace_back(0.0, y, 0.0);
  EXPECT_FALSE(reach_beyond(points, kPlatter, kCell_m));
}

TEST(ReachBeyond, LooksNoFartherThanThreeRadii) {
  const auto reach = reach_beyond(bar(-0.08, 1.0), kPlatter, kCell_m);
  ASSERT_TRUE(reach);
  EXPECT_LE(*reach, 0.3);
  EXPECT_GT(*reach, 0.29);
}

}  // namespace
}  // namespace turnscan::estimation
