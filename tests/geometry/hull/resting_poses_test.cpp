#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/geometry/hull/resting_poses.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

TriangleMesh box(const Vec3f& size) {
  TriangleMesh mesh = test::cube();
  for (Vec3f& v : mesh.vertices) v = v.cwiseProduct(size);
  return mesh;
}

/// Around y, from y = 0, with its caps.
TriangleMesh cone(double low_m, double high_m, double height_m, std::uint32_t segments) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const double a = 2.0 * std::numbers::pi * i / segments;
    for (const auto& [r, y] : {std::pair(low_m, 0.0), std::pair(high_m, height_m)})
      mesh.vertices.push_back(Vec3d(r * std::sin(a), y, r * std::cos(a)).cast<float>());
  }
  const std::uint32_t foot = 2 * segments, top = foot + 1;
  mesh.vertices.emplace_back(0.0f, 0.0f, 0.0f);
  mesh.vertices.emplace_back(0.0f, float(height_m), 0.0f);
  for (std::uint32_t i = 0; i < segments; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % segments);
    mesh.triangles.insert(mesh.triangles.end(),
                          {{a, b, b + 1}, {a, b + 1, a + 1}, {foot, b, a}, {top, a + 1, b + 1}});
  }
  return mesh;
}

TEST(RestingPoses, OfABoxAreItsSixFacesTheLowestFirst) {
  const auto poses = resting_poses(box(Vec3f(0.1f, 0.2f, 0.06f)));
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_NEAR(std::abs(poses[0].down.z()), 1.0, 1e-6);
  EXPECT_NEAR(poses[0].center_height_m, 0.03, 1e-6);
  EXPECT_NEAR(std::abs(poses[5].down.y()), 1.0, 1e-6);
  // About the edge of its foot that is 30 mm from the middle, of which the centre is 100 mm above.
  const double tilt = 15.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(poses[5].lift_m, 0.03 * std::sin(tilt) - 0.1 * (1.0 - std::cos(tilt)), 1e-5);
}

TEST(RestingPoses, ACylinderStandsOnItsEndsAndRollsOnItsSide) {
  const auto poses = resting_poses(cone(0.04, 0.04, 0.12, 180));
  ASSERT_EQ(poses.size(), 2u);
  for (const RestingPose& pose : poses) EXPECT_NEAR(std::abs(pose.down.y()), 1.0, 1e-6);
}

TEST(RestingPoses, WhatIsTooSteepFallsOver) {
  // On its tip of 2 mm a cone of 120 mm does not stand, nor does it on its side, where it rolls.
  const auto poses = resting_poses(cone(0.04, 0.002, 0.12, 180));
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_NEAR(poses[0].down.y(), -1.0, 1e-6);
}

TEST(RestingPoses, WhatRocksStandsAllTheSame) {
  // A dome below a plate, with three feet that are a little shorter than the dome: it rocks.
  TriangleMesh mesh = cone(0.06, 0.06, 0.004, 180);
  for (Vec3f& v : mesh.vertices) v.y() += 0.02f;
  test::append(mesh, test::sphere(0.02, 5, Vec3d(0.0, 0.02, 0.0)));
  const auto below = [](const std::vector<RestingPose>& poses) {
    return std::count_if(poses.begin(), poses.end(),
                         [](const RestingPose& pose) { return pose.down.y() < -0.9; });
  };
  EXPECT_EQ(below(resting_poses(mesh)), 0) << "without feet it rolls about the dome";
  for (const double turn : {0.0, 2.0, 4.0})
    test::append(
        mesh, test::sphere(0.004, 3, Vec3d(0.05 * std::cos(turn), 0.006, 0.05 * std::sin(turn))));
  EXPECT_GE(below(resting_poses(mesh)), 1);
}

TEST(RestingPoses, ABallHasNone) { EXPECT_TRUE(resting_poses(test::sphere(0.05, 5)).empty()); }

TEST(RestingPoses, AMeshWithoutVolumeHasNone) {
  EXPECT_TRUE(resting_poses(test::plane(3)).empty());
  EXPECT_TRUE(resting_poses(TriangleMesh()).empty());
  TriangleMesh inside_out = test::cube();
  test::flip(inside_out);
  EXPECT_TRUE(resting_poses(inside_out).empty());
}

TEST(CenterOfMass, OfAConeIsAQuarterOfItsHeight) {
  const Vec3d center = center_of_mass(cone(0.04, 0.0, 0.12, 720));
  EXPECT_NEAR(center.y(), 0.03, 1e-4);
  EXPECT_NEAR(center.head<1>().norm(), 0.0, 1e-6);
}

TEST(TippingDirection, IsTheMiddleOfTheWidestGap) {
  const Vec3d center(0.01, 0.05, 0.02);
  const std::vector<Vec3f> behind{{0.0f, 0.0f, 0.03f}, {0.0f, 0.0f, 0.01f}};
  const auto direction = tipping_direction(center, behind, 0.001);
  ASSERT_TRUE(direction);
  EXPECT_NEAR((*direction - Vec3d::UnitX()).norm(), 0.0, 1e-6);
}

TEST(TippingDirection, IsNoneAboveTheHullAndAboveAContact) {
  const Vec3d center(0.0, 0.05, 0.0);
  const std::vector<Vec3f> tripod{{0.03f, 0, 0}, {-0.01f, 0, 0.02f}, {-0.01f, 0, -0.02f}};
  EXPECT_FALSE(tipping_direction(center, tripod, 0.0));
  EXPECT_TRUE(tipping_direction(center + Vec3d(-0.02, 0, 0), tripod, 0.0));
  const std::vector<Vec3f> below{{0.002f, 0, 0}};
  EXPECT_FALSE(tipping_direction(center, below, 0.003));
  EXPECT_TRUE(tipping_direction(center, below, 0.001));
  EXPECT_TRUE(tipping_direction(center, {}, 0.001));
}

}  // namespace
}  // namespace turnscan
