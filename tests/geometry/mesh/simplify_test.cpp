#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>

#include "tests/geometry/dense_grid.hpp"

namespace turnscan {
namespace {

/// Two balls joined by a thin neck: where collapses like to pinch.
TriangleMesh dumbbell() {
  DenseGrid grid{Vec3d(-2.2, -1.2, -1.2), 0.1, {45, 25, 25}, {}};
  for (int k = 0; k < 25; ++k) {
    for (int j = 0; j < 25; ++j) {
      for (int i = 0; i < 45; ++i) {
        const Vec3d p = grid.origin_m + grid.cell_m * Vec3d(i, j, k);
        const double balls =
            std::min((p - Vec3d(1.1, 0, 0)).norm(), (p + Vec3d(1.1, 0, 0)).norm()) - 0.9;
        const double neck = std::max(std::hypot(p.y(), p.z()) - 0.12, std::abs(p.x()) - 1.0);
        grid.values.push_back(float(std::min(balls, neck)));
      }
    }
  }
  return *isosurface(grid, {}, RunContext());
}

TEST(Simplify, MeetsTheCountAndStaysWatertight) {
  const TriangleMesh mesh = dumbbell();
  for (const std::size_t share : {2u, 5u, 20u, 100u}) {
    const auto out = simplify(mesh, {mesh.triangles.size() / share, 1e30});
    ASSERT_TRUE(out) << out.error().text();
    EXPECT_TRUE(check_mesh(*out).watertight()) << check_mesh(*out).text();
    EXPECT_LT(out->triangles.size(), mesh.triangles.size());
    if (share <= 5) {
      EXPECT_LE(out->triangles.size(), mesh.triangles.size() / share * 11 / 10);
    }
  }
}

TEST(Simplify, KeepsWithinTheError) {
  const TriangleMesh mesh = dumbbell();
  const auto out = simplify(mesh, {4, 0.01});
  ASSERT_TRUE(out) << out.error().text();
  EXPECT_GT(out->triangles.size(), 100u);
  EXPECT_NEAR(check_mesh(*out).volume_m3, check_mesh(mesh).volume_m3, 0.12);
}

TEST(Simplify, KeepsTheTrianglesThatAreToStay) {
  const TriangleMesh mesh = dumbbell();
  SimplifyGoal goal{4, 0.05};
  const auto corner = [&](std::size_t t) { return mesh.vertices[mesh.triangles[t][0]]; };
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    goal.keep.push_back(corner(t).x() > 0.8f ? 1 : 0);
    kept += goal.keep.back();
  }
  const auto out = simplify(mesh, goal);
  ASSERT_TRUE(out) << out.error().text();
  EXPECT_TRUE(check_mesh(*out).watertight()) << check_mesh(*out).text();
  EXPECT_GT(out->triangles.size(), kept);
  EXPECT_LT(out->triangles.size() - kept, (mesh.triangles.size() - kept) / 4);
  std::size_t there = 0;
  for (const auto& t : out->triangles) there += out->vertices[t[0]].x() > 0.8f ? 1 : 0;
  EXPECT_GE(there, kept);
}

TEST(Simplify, LeavesAMeshAloneThatHasFewEnough) {
  const TriangleMesh mesh = dumbbell();
  EXPECT_EQ(simplify(mesh, {mesh.triangles.size(), 1e30})->triangles, mesh.triangles);
  EXPECT_TRUE(simplify(TriangleMesh(), {10, 1e30})->empty());
}

TEST(Simplify, AttributesComeAlong) {
  TriangleMesh mesh = dumbbell();
  for (const Vec3f& v : mesh.vertices)
    mesh.colors.push_back({std::uint8_t(v.x() > 0.0f ? 200 : 50), 0, 0});
  const auto out = simplify(mesh, {mesh.triangles.size() / 4, 1e30});
  ASSERT_TRUE(out);
  ASSERT_EQ(out->colors.size(), out->vertices.size());
  for (std::size_t v = 0; v < out->vertices.size(); ++v)
    EXPECT_EQ(out->colors[v].r, out->vertices[v].x() > 0.0f ? 200 : 50);
}

TEST(Simplify, RefusesABrokenMesh) {
  TriangleMesh mesh = dumbbell();
  mesh.triangles[0][0] = 1u << 30;
  EXPECT_FALSE(simplify(mesh, {10, 1e30}));
}

}  // namespace
}  // namespace turnscan
