#include <gtest/gtest.h>

#include <turnscan/reconstruction/texture/lamp_view.hpp>

namespace turnscan::texture {
namespace {

/// Level, faces up; its middle lies above the origin.
void add_square(TriangleMesh& mesh, float half_m, float height_m) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const auto& [x, z] : {std::pair{-1.0f, -1.0f}, {-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}})
    mesh.vertices.emplace_back(half_m * x, height_m, half_m * z);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A table with a small roof above it.
TriangleMesh table_and_roof() {
  TriangleMesh mesh;
  add_square(mesh, 0.1f, 0.0f);
  add_square(mesh, 0.02f, 0.05f);
  return mesh;
}

const Vec3f kUp = Vec3f::UnitY();

TEST(LampView, WhatLiesBehindSomethingIsInShadow) {
  const LampView above(table_and_roof(), kUp, 0.5e-3);
  EXPECT_EQ(above.lit({0.0f, 0.05f, 0.0f}, kUp), Lit::kYes);
  EXPECT_EQ(above.lit({0.0f, 0.0f, 0.0f}, kUp), Lit::kNo);
  EXPECT_EQ(above.lit({0.015f, 0.0f, -0.015f}, kUp), Lit::kNo);
  EXPECT_EQ(above.lit({0.05f, 0.0f, 0.0f}, kUp), Lit::kYes);
}

TEST(LampView, AShadowFallsAwayFromTheLamp) {
  // 45 degrees from +X: the shadow lies 5 cm towards -X.
  const LampView aside(table_and_roof(), Vec3f(1.0f, 1.0f, 0.0f).normalized(), 0.5e-3);
  EXPECT_EQ(aside.lit({-0.05f, 0.0f, 0.0f}, kUp), Lit::kNo);
  EXPECT_EQ(aside.lit({0.0f, 0.0f, 0.0f}, kUp), Lit::kYes);
  EXPECT_EQ(aside.lit({0.05f, 0.0f, 0.0f}, kUp), Lit::kYes);
}

TEST(LampView, IsUnsureOnBothSidesOfTheEdgeOfAShadow) {
  const LampView above(table_and_roof(), kUp, 0.5e-3);
  EXPECT_EQ(above.lit({0.0195f, 0.0f, 0.0f}, kUp), Lit::kUnsure);
  EXPECT_EQ(above.lit({0.0205f, 0.0f, 0.0f}, kUp), Lit::kUnsure);
}

TEST(LampView, WhatFacesAwayIsNotReached) {
  const LampView above(table_and_roof(), kUp, 0.5e-3);
  EXPECT_EQ(above.lit({0.05f, 0.0f, 0.0f}, -kUp), Lit::kNo);
}

}  // namespace
}  // namespace turnscan::texture
