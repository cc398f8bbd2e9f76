#include <gtest/gtest.h>

#include <array>
#include <tests/reconstruction/passes/lumpy_object.hpp>
#include <turnscan/reconstruction/object_partition.hpp>

namespace turnscan {
namespace {

TriangleMesh ball_at(float x) {
  TriangleMesh ball = testing::star_mesh(testing::ball_radius);
  for (Vec3f& p : ball.vertices) p += Vec3f(x, 0.06f, 0.0f);
  return ball;
}

TEST(ObjectPartition, WhatIsNearestToTheChosenIsTheirs) {
  const TriangleMesh left = ball_at(-0.1f), right = ball_at(0.1f);
  const ObjectPartition all(std::array<const TriangleMesh*, 2>{&left, &right});
  const ObjectPartition of_left = all.of(std::array<std::size_t, 1>{0});
  const ObjectPartition of_right = all.of(std::array<std::size_t, 1>{1});
  for (const Vec3f& p : left.vertices) {
    EXPECT_TRUE(all.contains(p));
    EXPECT_TRUE(of_left.contains(p));
    EXPECT_FALSE(of_right.contains(p));
  }
  EXPECT_TRUE(of_left.contains({-0.01f, 0.06f, 0.0f}));
  EXPECT_TRUE(of_right.contains({0.01f, 0.06f, 0.0f}));
}

TEST(ObjectPartition, BeyondItsGridTheNearestCellDecides) {
  const TriangleMesh left = ball_at(-0.1f), right = ball_at(0.1f);
  const ObjectPartition share = ObjectPartition(std::array<const TriangleMesh*, 2>{&left, &right})
                                    .of(std::array<std::size_t, 1>{1});
  EXPECT_TRUE(share.contains({1e9f, 0.0f, 0.0f}));
  EXPECT_FALSE(share.contains({-1e9f, 5.0f, 5.0f}));
}

}  // namespace
}  // namespace turnscan
