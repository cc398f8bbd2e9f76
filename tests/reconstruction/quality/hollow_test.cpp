#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/quality/hollow.hpp>

namespace turnscan::quality {
namespace {

/// An outline of (radius, height) from the axis to the axis, in metres, turned about it.
TriangleMesh lathe(const std::vector<std::pair<double, double>>& outline) {
  constexpr std::uint32_t kAround = 96;
  TriangleMesh mesh;
  for (const auto& [r, y] : outline)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double angle = kTurn * k / kAround;
      mesh.vertices.emplace_back(float(r * std::cos(angle)), float(y), float(r * std::sin(angle)));
    }
  for (std::uint32_t i = 0; i + 1 < outline.size(); ++i)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = i * kAround + k, b = i * kAround + (k + 1) % kAround;
      mesh.triangles.push_back({a, a + kAround, b});
      mesh.triangles.push_back({b, a + kAround, b + kAround});
    }
  return mesh;
}

/// Parallel views from all around at an elevation.
std::vector<views::DepthView> views_from(double elevation_deg) {
  std::vector<views::DepthView> out;
  for (double heading = 0.0; heading < kTurn; heading += kTurn / 24) {
    const double e = elevation_deg * kRadiansPerDegree;
    const Vec3d forward(-std::cos(heading) * std::cos(e), -std::sin(e),
                        -std::sin(heading) * std::cos(e));
    const Vec3d right = Vec3d(-Vec3d::UnitY()).cross(forward).normalized();
    Eigen::Matrix3d rotation;
    rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    views::DepthView view;
    view.rotation = rotation.cast<float>();
    view.parallel = true;
    out.push_back(view);
  }
  return out;
}

/// In cm3; measured: all of the mesh.
double unknown_cm3(const TriangleMesh& mesh, double elevation_deg,
                   Evidence evidence = Evidence::kMeasured) {
  const std::vector<Evidence> all(mesh.triangles.size(), evidence);
  return 1e6 * unknown_volume_m3(mesh, all, views_from(elevation_deg), 0.004);
}

/// 80 mm wide and 100 mm high with walls of 4 mm, filled to a depth below its rim.
TriangleMesh cup(double depth_m) {
  return lathe({{0.0, 0.0},
                {0.04, 0.0},
                {0.04, 0.1},
                {0.036, 0.1},
                {0.036, 0.1 - depth_m},
                {0.0, 0.1 - depth_m}});
}

TEST(UnknownVolume, IsWhatACupHoldsBelowWhereRaysEnd) {
  // At 20 degrees rays end 13 to 26 mm below the rim.
  const double below = EIGEN_PI * 3.6 * 3.6 * 8.0;
  EXPECT_NEAR(unknown_cm3(cup(0.02), 20.0), below, 0.1 * below);
}

TEST(UnknownVolume, IsNoneWhereTheFloorWouldBeSeenFartherDown) {
  EXPECT_EQ(unknown_cm3(cup(0.02), 60.0), 0.0);
}

TEST(UnknownVolume, IsBelowAFloorThatNothingMeasured) {
  const double below = EIGEN_PI * 3.6 * 3.6 * 8.0;
  EXPECT_NEAR(unknown_cm3(cup(0.02), 60.0, Evidence::kInvented), below, 0.1 * below);
}

TEST(UnknownVolume, IsNoneInWhatHasNoHollow) {
  const auto pawn = lathe({{0.0, 0.0}, {0.04, 0.0}, {0.02, 0.05}, {0.03, 0.1}, {0.0, 0.1}});
  EXPECT_EQ(unknown_cm3(pawn, 5.0, Evidence::kInvented), 0.0);
  EXPECT_EQ(unknown_cm3(cup(0.003), 5.0), 0.0)
      << "a dent that is no deeper than a floor may be off";
}

TEST(UnknownVolume, ReachesIntoTheBellyOfAVaseWithAThinWall) {
  const auto vase = [](double neck_wall_m) {
    return lathe({{0.0, 0.0},
                  {0.03, 0.0},
                  {0.06, 0.05},
                  {0.03, 0.1},
                  {0.02 + neck_wall_m, 0.12},
                  {0.02, 0.12},
                  {0.02, 0.11},
                  {0.0, 0.11}});
  };
  const double thin = unknown_cm3(vase(0.003), 15.0), all = 1e6 * signed_volume(vase(0.003));
  EXPECT_GT(std::abs(thin), 0.6 * std::abs(all));
  EXPECT_LT(thin, std::abs(all));
  const double column = EIGEN_PI * 2.0 * 2.0 * 11.0;
  EXPECT_NEAR(unknown_cm3(vase(0.03), 15.0), column, 0.15 * column)
      << "a bore in a thick body says nothing of the body";
}

TEST(UnknownVolume, DoesNotCountAFloorOfWhichMostWasSeen) {
  // A step across the floor hides a strip beside it.
  const auto bowl = lathe({{0.0, 0.0},
                           {0.06, 0.0},
                           {0.06, 0.03},
                           {0.05, 0.03},
                           {0.045, 0.01},
                           {0.006, 0.01},
                           {0.005, 0.025},
                           {0.0, 0.025}});
  EXPECT_EQ(unknown_cm3(bowl, 50.0), 0.0);
}

}  // namespace
}  // namespace turnscan::quality
