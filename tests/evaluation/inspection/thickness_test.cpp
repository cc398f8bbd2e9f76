#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/evaluation/inspection/thickness.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

TEST(Thickness, OfAHollowBallIsThatOfItsWall) {
  TriangleMesh mesh = test::sphere(0.02, 5), inside = test::sphere(0.018, 5);
  test::flip(inside);
  test::append(mesh, inside);
  const auto thickness = wall_thicknesses(mesh, RunContext());
  ASSERT_TRUE(thickness) << thickness.error().text();
  // Along the radius a ray may pass exactly through a vertex of the other side, which Embree may
  // miss.
  std::size_t off = 0;
  for (const float t : *thickness) off += std::abs(t - 0.002f) < 2e-5f ? 0 : 1;
  EXPECT_LT(off, thickness->size() / 20);
}

TEST(Thickness, OfAnOpenSurfaceIsNotKnownAndGrey) {
  const TriangleMesh mesh = test::plane(3);
  const auto thickness = wall_thicknesses(mesh, RunContext());
  ASSERT_TRUE(thickness);
  for (const float t : *thickness) EXPECT_TRUE(std::isnan(t));
  EXPECT_EQ(color_by_thickness(mesh, *thickness, 1.0).colors[0], (Rgb{128, 128, 128}));
}

TEST(Thickness, ThinWallsAreYellow) {
  const TriangleMesh mesh = test::tetrahedron();
  const TriangleMesh colored = color_by_thickness(mesh, {0.0f, 1.0f, 2.0f, 9.0f}, 2.0);
  EXPECT_EQ(colored.colors[0], viridis(1.0));
  EXPECT_EQ(colored.colors[1], viridis(0.5));
  EXPECT_EQ(colored.colors[3], viridis(0.0));
}

}  // namespace
}  // namespace turnscan
