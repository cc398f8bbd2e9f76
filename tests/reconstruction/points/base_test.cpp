#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/reconstruction/points/base.hpp>

namespace turnscan::points {
namespace {

constexpr double kCell = 0.001;

/// The outer (or, with inward = true, inner) wall of a tube around (x, z), from 2 mm upwards.
void add_tube(PointCloud& cloud, double x, double z, double radius, bool inward) {
  for (double y = 0.002; y < 0.03; y += kCell)
    for (double a = 0; a < 2 * std::numbers::pi; a += kCell / radius) {
      const Vec3f n(float(std::cos(a)), 0, float(std::sin(a)));
      cloud.points.emplace_back(float(x + radius * n.x()), float(y), float(z + radius * n.z()));
      cloud.normals.push_back(inward ? Vec3f(-n) : n);
    }
}

double disc(double r) { return std::numbers::pi * r * r; }

TEST(Base, ClosesACylinderOverItsWholeFootprint) {
  PointCloud cloud;
  add_tube(cloud, 0.01, -0.02, 0.02, false);
  const BaseResult base = close_base(cloud, kCell, 0.006);
  EXPECT_NEAR(base.area_m2, disc(0.02), 0.06 * disc(0.02));
  for (std::size_t i = 0; i < base.added.size(); ++i) {
    const Vec3f& p = base.added.points[i];
    EXPECT_LT(std::hypot(p.x() - 0.01f, p.z() + 0.02f), 0.0213f);
    EXPECT_GE(p.y(), 0.0f);
  }
}

TEST(Base, CarriesTheWallsOnToThePlatter) {
  PointCloud cloud;
  add_tube(cloud, 0, 0, 0.02, false);
  const BaseResult base = close_base(cloud, kCell, 0.006);
  EXPECT_GT(base.walls, 60u);
  float lowest = 1.0f;
  for (std::size_t i = 0; i < base.added.size(); ++i) {
    if (base.added.normals[i].y() < -0.5f) continue;
    lowest = std::min(lowest, base.added.points[i].y());
    EXPECT_NEAR(std::hypot(base.added.points[i].x(), base.added.points[i].z()), 0.02f, 0.0006f);
  }
  EXPECT_LT(lowest, 0.0013f);
}

TEST(Base, LeavesTheHollowOfATubeOpen) {
  PointCloud cloud;
  add_tube(cloud, 0, 0, 0.02, false);
  add_tube(cloud, 0, 0, 0.012, true);
  const BaseResult base = close_base(cloud, kCell, 0.006);
  const double ring = disc(0.02) - disc(0.012);
  EXPECT_NEAR(base.area_m2, ring, 0.1 * ring);
}

TEST(Base, ClosesSeparateFeetEachOnItsOwn) {
  PointCloud cloud;
  add_tube(cloud, -0.03, 0, 0.01, false);
  add_tube(cloud, 0.03, 0, 0.008, false);
  const BaseResult base = close_base(cloud, kCell, 0.006);
  const double feet = disc(0.01) + disc(0.008);
  EXPECT_NEAR(base.area_m2, feet, 0.1 * feet);
  for (const Vec3f& p : base.added.points) EXPECT_GT(std::abs(p.x()), 0.018f);
}

TEST(Base, BridgesAGapInTheOutline) {
  PointCloud whole, cloud;
  add_tube(whole, 0, 0, 0.02, false);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole.points[i].x() > 0.0195f) continue;  // an eighth of the outline was not seen
    cloud.points.push_back(whole.points[i]);
    cloud.normals.push_back(whole.normals[i]);
  }
  const BaseResult base = close_base(cloud, kCell, 0.006);
  EXPECT_NEAR(base.area_m2, disc(0.02), 0.1 * disc(0.02));
}

TEST(Base, AddsNothingUnderAnObjectThatHangsAboveThePlatter) {
  PointCloud cloud;
  add_tube(cloud, 0, 0, 0.02, false);
  for (Vec3f& p : cloud.points) p.y() += 0.05f;
  EXPECT_TRUE(close_base(cloud, kCell, 0.006).added.empty());
}

TEST(Base, AddsNothingToNothing) { EXPECT_TRUE(close_base({}, kCell, 0.006).added.empty()); }

}  // namespace
}  // namespace turnscan::points
