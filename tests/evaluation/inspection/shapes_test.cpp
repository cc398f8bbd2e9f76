#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/evaluation/inspection/shapes.hpp>
#include <vector>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

Vec3d random_point(std::uint64_t i) {
  return {random_value(3, i, 0), random_value(3, i, 1), random_value(3, i, 2)};
}

TEST(Angle, IsTheOneBetweenTheWaysToTheOthers) {
  EXPECT_NEAR(*angle_at({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(*angle_at({1, 1, 1}, {2, 1, 1}, {0, 1, 1}), std::numbers::pi, 1e-12);
  EXPECT_FALSE(angle_at({1, 1, 1}, {1, 1, 1}, {0, 1, 1}));
}

TEST(Angle, OfThreeCornersAddsUpToHalfATurn) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Vec3d a = random_point(3 * i), b = random_point(3 * i + 1), c = random_point(3 * i + 2);
    EXPECT_NEAR(*angle_at(a, b, c) + *angle_at(b, c, a) + *angle_at(c, a, b), std::numbers::pi,
                1e-12);
  }
}

TEST(Circle, ThroughThreePointsIsEquallyFarFromAll) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Vec3d a = random_point(3 * i), b = random_point(3 * i + 1), c = random_point(3 * i + 2);
    const auto circle = circle_through(a, b, c);
    ASSERT_TRUE(circle);
    for (const Vec3d& p : {a, b, c}) {
      EXPECT_NEAR((p - circle->center).norm() / circle->radius_m, 1.0, 1e-9);
      EXPECT_NEAR((p - circle->center).dot(circle->normal) / circle->radius_m, 0.0, 1e-9);
    }
  }
}

TEST(Circle, ThroughPointsOnALineIsNone) {
  EXPECT_FALSE(circle_through({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  EXPECT_FALSE(circle_through({0, 0, 0}, {0, 0, 0}, {2, 2, 2}));
}

TEST(FittedPlane, HasTheFlatnessOfItsPoints) {
  // A chessboard of 2 mm steps, tilted.
  const Vec3d n = Vec3d(1, 2, 3).normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  std::vector<Vec3d> points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      points.emplace_back(Vec3d(5, 5, 5) + 0.01 * i * u + 0.01 * j * v +
                          ((i + j) % 2 == 0 ? 0.001 : -0.001) * n);
  const auto fit = plane_through(points);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(std::abs(fit->normal.dot(n)), 1.0, 1e-6);
  EXPECT_NEAR(fit->flatness_m, 0.002, 1e-5);
  EXPECT_NEAR(fit->rms_m, 0.001, 1e-6);
  EXPECT_EQ(fit->count, 400u);
}

TEST(FittedPlane, NeedsThreePointsThatAreNotOnALine) {
  EXPECT_FALSE(plane_through(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(plane_through(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
}

TEST(SurfacePoint, IsTheNearestOneWithTheWeightsOfItsCorners) {
  const TriangleMesh ball = sphere(1.0, 3);
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Vec3d place = 2.0 * random_point(i);
    const auto found = nearest_surface_point(ball, place);
    ASSERT_TRUE(found);
    Vec3d sum = Vec3d::Zero();
    for (int c = 0; c < 3; ++c)
      sum += found->weights[c] *
             ball.vertices[ball.triangles[found->triangle][std::size_t(c)]].cast<double>();
    EXPECT_NEAR((sum - found->point).norm(), 0.0, 1e-9);
    EXPECT_NEAR(found->distance_m, std::abs(place.norm() - 1.0), 0.02);
    EXPECT_GT(found->normal.dot(found->point), 0.95);
  }
  EXPECT_FALSE(nearest_surface_point({}, Vec3d::Zero()));
}

TEST(Wall, IsAsThickAsTheBoxAndTheShell) {
  const auto on_top = nearest_surface_point(cube(), {0.4, 0.3, 1.2});
  ASSERT_TRUE(on_top);
  EXPECT_NEAR(*wall_thickness(cube(), *on_top), 1.0, 1e-9);
  TriangleMesh shell = sphere(0.05, 5), inner = sphere(0.047, 5);
  flip(inner);
  append(shell, inner);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto at = nearest_surface_point(shell, 0.06 * random_point(i).normalized());
    ASSERT_TRUE(at);
    const auto thickness = wall_thickness(shell, *at);
    ASSERT_TRUE(thickness);
    EXPECT_NEAR(*thickness, 0.003, 5e-5) << i;
  }
}

TEST(Wall, BehindAnOpenSurfaceIsNone) {
  const TriangleMesh sheet = plane(4);
  EXPECT_FALSE(wall_thickness(sheet, *nearest_surface_point(sheet, {0.4, 0.4, 0.1})));
}

}  // namespace
}  // namespace turnscan
