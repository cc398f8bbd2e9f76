#include <turnscan/geometry/selection/screen_selection.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

/// A camera 0.3 m from the origin on `from`, looking at it; 1 mm there is about 3 pixels.
ScreenView camera(const Vec3d& from) {
  const Vec3d forward = -from.normalized();
  const Vec3d right = forward.cross(forward.unitOrthogonal()).normalized();
  const Vec3d down = forward.cross(right), eye = -0.3 * forward;
  constexpr double kFocal = 900.0;
  ScreenView view;
  view.width = 400;
  view.height = 300;
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.block<1, 3>(0, 0) = right;
  pose.block<1, 3>(1, 0) = down;
  pose.block<1, 3>(2, 0) = forward;
  pose.block<3, 1>(0, 3) = -pose.block<3, 3>(0, 0) * eye;
  Eigen::Matrix4d lens;
  lens << kFocal, 0, 200, 0, 0, kFocal, 150, 0, 0, 0, 0, 1, 0, 0, 1, 0;
  view.to_pixels = lens * pose;
  return view;
}

Vec3d eye_of(const Vec3d& from) { return 0.3 * from.normalized(); }

ScreenRegion everything() { return {{{-1, -1}, {401, -1}, {401, 301}, {-1, 301}}, 0.0}; }

Vec3d random_way(std::uint64_t i) {
  return Vec3d(random_value(3, i, 0), random_value(3, i, 1), random_value(3, i, 2)).normalized();
}

Vec3d middle_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]).cast<double>() / 3.0;
}

/// How far from the eye the line of sight to p meets another triangle, as a share of the way.
double first_hit(const TriangleMesh& mesh, const Vec3d& eye, const Vec3d& p, std::size_t but) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t == but) continue;
    const auto& tri = mesh.triangles[t];
    const Vec3d a = mesh.vertices[tri[0]].cast<double>(), b = mesh.vertices[tri[1]].cast<double>(),
                c = mesh.vertices[tri[2]].cast<double>();
    Eigen::Matrix3d m;
    m << b - a, c - a, eye - p;
    if (std::abs(m.determinant()) < 1e-18) continue;
    const Vec3d s = m.inverse() * (eye - a);
    if (s[0] >= 0 && s[1] >= 0 && s[0] + s[1] <= 1 && s[2] > 0) nearest = std::min(nearest, s[2]);
  }
  return nearest;
}

TEST(ScreenSelection, OfWhatIsVisibleAgreesWithRays) {
  TriangleMesh scene = torus(0.03, 0.01, 32, 16);
  append(scene, sphere(0.012, 3, Vec3d(0.01, 0.02, 0.01)));
  std::size_t wrong = 0, asked = 0, seen = 0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Vec3d from = random_way(i), eye = eye_of(from);
    const auto made = select_on_screen(scene, everything(), camera(from), true, {});
    ASSERT_TRUE(made);
    for (std::size_t t = 0; t < scene.triangles.size(); t += 7) {
      const Vec3d p = middle_of(scene, t);
      const double hit = first_hit(scene, eye, p, t);
      ++asked;
      seen += (*made)[t] != 0 ? 1 : 0;
      // On the rim of what is seen one pixel decides.
      if (((*made)[t] != 0) != (hit > 1.0) && std::abs(hit - 1.0) * 0.3 > 0.001) ++wrong;
    }
  }
  EXPECT_GT(seen, asked / 5);
  EXPECT_LT(seen, 2 * asked / 3);
  EXPECT_LE(wrong, asked / 100) << wrong << " of " << asked;
}

TEST(ScreenSelection, ThroughTakesAllThatLieThere) {
  const TriangleMesh ball = sphere(0.02, 4);
  const ScreenView view = camera(Vec3d::UnitZ());
  const auto all = select_on_screen(ball, everything(), view, false, {});
  ASSERT_TRUE(all);
  EXPECT_EQ(count_selected(*all), ball.triangles.size());
  // The left half of the screen: as the middles of the triangles say.
  const ScreenRegion left{{{-1, -1}, {200, -1}, {200, 301}, {-1, 301}}, 0.0};
  const auto half = select_on_screen(ball, left, view, false, {});
  ASSERT_TRUE(half);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const Eigen::Vector4d q = view.to_pixels * middle_of(ball, t).homogeneous();
    EXPECT_EQ((*half)[t] != 0, std::floor(q.x() / q.w()) < 200.0) << t;
  }
}

TEST(ScreenSelection, OfTrianglesSmallerThanPixelsTakesTheFrontOfABallOnly) {
  const TriangleMesh ball = sphere(0.02, 6);  // 32768 triangles in some 11000 pixels
  const Vec3d eye = eye_of(Vec3d::UnitX());
  const auto made = select_on_screen(ball, everything(), camera(Vec3d::UnitX()), true, {});
  ASSERT_TRUE(made);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const Vec3d p = middle_of(ball, t);
    const double facing = p.normalized().dot((eye - p).normalized());
    if (facing > 0.15) {
      EXPECT_NE((*made)[t], 0) << facing;
    }
    if (facing < -0.05) {
      EXPECT_EQ((*made)[t], 0) << facing;
    }
  }
}

TEST(ScreenSelection, DoesNotReachTheOtherSideOfAThinWall) {
  TriangleMesh wall = plane(40, 0.04, 0.0005);
  TriangleMesh back = plane(40, 0.04, 0.0);
  flip(back);
  const std::size_t front = wall.triangles.size();
  append(wall, back);
  const auto made = select_on_screen(wall, everything(), camera(Vec3d(0.1, 0.2, 1.0)), true, {});
  ASSERT_TRUE(made);
  for (std::size_t t = 0; t < made->size(); ++t) EXPECT_EQ((*made)[t] != 0, t < front) << t;
}

TEST(ScreenSelection, BrushTakesATriangleMuchLargerThanItself) {
  TriangleMesh large;
  large.vertices = {{-0.03f, -0.03f, 0}, {0.03f, -0.03f, 0}, {0, 0.03f, 0}};
  large.triangles = {{0, 1, 2}};
  const ScreenView view = camera(Vec3d::UnitZ());
  const Eigen::Vector4d q = view.to_pixels * Vec3d(0.0, -0.025, 0.0).homogeneous();
  const Eigen::Vector2d at = q.head<2>() / q.w();
  const auto touched = select_on_screen(large, {{at}, 3.0}, view, true, {});
  ASSERT_TRUE(touched);
  EXPECT_EQ(count_selected(*touched), 1u);
  const auto beside = select_on_screen(large, {{{5.0, 5.0}}, 3.0}, view, true, {});
  ASSERT_TRUE(beside);
  EXPECT_EQ(count_selected(*beside), 0u);
}

TEST(ScreenSelection, LeavesOutWhatIsBehindTheCamera) {
  const TriangleMesh ball = sphere(0.02, 3, Vec3d(0, 0, 0.6));
  const auto made = select_on_screen(ball, everything(), camera(Vec3d::UnitZ()), false, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(count_selected(*made), 0u);
}

TEST(ScreenSelection, OfPointsTakesTheFrontOfADenseBall) {
  const TriangleMesh ball = sphere(0.02, 6);
  const Vec3d eye = eye_of(Vec3d::UnitY());
  const ScreenView view = camera(Vec3d::UnitY());
  const auto made = select_on_screen(ball.vertices, everything(), view, true, {});
  const auto through = select_on_screen(ball.vertices, everything(), view, false, {});
  ASSERT_TRUE(made && through);
  EXPECT_EQ(count_selected(*through), ball.vertices.size());
  for (std::size_t i = 0; i < ball.vertices.size(); ++i) {
    const Vec3d p = ball.vertices[i].cast<double>();
    const double facing = p.normalized().dot((eye - p).normalized());
    if (facing > 0.35) {
      EXPECT_NE((*made)[i], 0) << facing;
    }
    if (facing < -0.35) {
      EXPECT_EQ((*made)[i], 0) << facing;
    }
  }
}

TEST(RegionMask, OfAStrokeAndOfACircleHaveTheirAreas) {
  ScreenRegion circle;
  for (int i = 0; i < 200; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 200;
    circle.points.emplace_back(100 + 60 * std::cos(a), 90 + 60 * std::sin(a));
  }
  const auto area = [](const std::vector<std::uint8_t>& mask) {
    return double(count_selected(mask));
  };
  EXPECT_NEAR(area(region_mask(circle, 200, 200)), std::numbers::pi * 3600, 40);
  const ScreenRegion stroke{{{50, 50}, {150, 50}}, 10.0};
  EXPECT_NEAR(area(region_mask(stroke, 200, 200)), 2000 + std::numbers::pi * 100, 30);
  EXPECT_EQ(area(region_mask(circle, 0, 0)), 0.0);
  EXPECT_EQ(area(region_mask({}, 20, 20)), 0.0);
  // What lies beyond the screen is cut off.
  EXPECT_EQ(area(region_mask({{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, 0.0}, 200, 200)), 2500);
}

}  // namespace
}  // namespace turnscan
