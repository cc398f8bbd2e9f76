#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tests/reconstruction/mesh_refinement/lens_mesh.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_untangle.hpp>

namespace turnscan::mesh_refinement {
namespace {

constexpr float kHalfThickness_m = 0.003f;

/// 6 mm thick.
TriangleMesh sheet() {
  return testing::lens([](float) { return kHalfThickness_m; });
}

/// Both sides within so far from the axis pass through each other by as much as they were apart.
TriangleMesh crossed(float radius_m) {
  TriangleMesh mesh = sheet();
  for (Vec3f& p : mesh.vertices)
    if (std::hypot(p.x(), p.z()) < radius_m) p.y() = -p.y();
  return mesh;
}

std::ptrdiff_t faults(const TriangleMesh& mesh) {
  return std::ptrdiff_t(self_intersections(mesh).edges);
}

TEST(UntangleMesh, TwoSidesThatPassedThroughEachOtherLieNearEachOther) {
  TriangleMesh mesh = crossed(0.012f);
  ASSERT_GT(faults(mesh), 0);
  ASSERT_TRUE(untangle(mesh, sheet().vertices, {}, RunContext()));
  EXPECT_EQ(faults(mesh), 0);
  // The middles of both sides.
  const float apart = mesh.vertices[0].y() - mesh.vertices[mesh.vertices.size() / 2].y();
  EXPECT_GT(apart, 0.0f);
  EXPECT_LT(apart, kHalfThickness_m);
}

TEST(UntangleMesh, WhatLiesApartFromTheFaultsStays) {
  TriangleMesh mesh = crossed(0.012f);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(untangle(mesh, sheet().vertices, {}, RunContext()));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3f& p = before.vertices[v];
    if (std::hypot(p.x(), p.z()) < 0.02f) continue;
    ASSERT_EQ(mesh.vertices[v], p) << v;
  }
}

TEST(UntangleMesh, AMeshThatDoesNotPassThroughItselfStaysAsItIs) {
  TriangleMesh mesh = sheet();
  std::vector<Vec3f> start = mesh.vertices;
  for (Vec3f& p : start) p *= 1.1f;
  ASSERT_TRUE(untangle(mesh, start, {}, RunContext()));
  EXPECT_EQ(mesh.vertices, sheet().vertices);
}

TEST(UntangleMesh, WhatPassedThroughItselfBeforeIsAveragedApart) {
  TriangleMesh mesh = crossed(0.003f);
  ASSERT_TRUE(untangle(mesh, crossed(0.003f).vertices, {}, RunContext()));
  EXPECT_EQ(faults(mesh), 0);
}

TEST(UntangleMesh, OnlyLooseVerticesMoveWhereTheySuffice) {
  TriangleMesh mesh = sheet();
  std::vector<std::uint8_t> upper(mesh.vertices.size(), 0);
  std::fill_n(upper.begin(), upper.size() / 2, std::uint8_t(1));
  for (std::size_t v = 0; v < upper.size() / 2; ++v) {
    Vec3f& p = mesh.vertices[v];
    if (std::hypot(p.x(), p.z()) < 0.012f) p.y() = -1.5f * p.y();
  }
  ASSERT_GT(faults(mesh), 0);
  ASSERT_TRUE(untangle(mesh, sheet().vertices, upper, RunContext()));
  EXPECT_EQ(faults(mesh), 0);
  for (std::size_t v = upper.size() / 2; v < upper.size(); ++v)
    ASSERT_EQ(mesh.vertices[v], sheet().vertices[v]) << v;
}

TEST(UntangleMesh, TheOthersMoveWhereLooseVerticesDoNotSuffice) {
  TriangleMesh mesh = sheet();
  mesh.vertices[0].y() *= -1.5f;  // the upper middle, through the lower side
  std::vector<std::uint8_t> loose(mesh.vertices.size(), 0);
  loose[loose.size() / 2] = 1;  // the lower middle
  const std::vector<Vec3f> start = mesh.vertices;
  ASSERT_GT(faults(mesh), 0);
  ASSERT_TRUE(untangle(mesh, start, loose, RunContext()));
  EXPECT_EQ(faults(mesh), 0);
}

TEST(UntangleMesh, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  TriangleMesh one = crossed(0.012f), many = one, none = one;
  set_thread_count(1);
  ASSERT_TRUE(untangle(one, sheet().vertices, {}, RunContext()));
  set_thread_count(0);
  ASSERT_TRUE(untangle(many, sheet().vertices, {}, RunContext()));
  EXPECT_EQ(one.vertices, many.vertices);
  const RunContext context;
  context.cancel();
  const auto result = untangle(none, sheet().vertices, {}, context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
