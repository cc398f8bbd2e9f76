#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/poisson/poisson.hpp>
#include <turnscan/reconstruction/surface/concave_hull.hpp>
#include <turnscan/reconstruction/surface/surface_repair.hpp>

namespace turnscan::surface {
namespace {

PointCloud sphere_points(std::size_t n, double radius, double open_below = -2.0) {
  PointCloud cloud;
  for (std::uint64_t i = 0; cloud.size() < n; ++i) {
    const double y = 2 * uniform01(hash_key(1, i, 0)) - 1, r = std::sqrt(1 - y * y);
    const double a = 2 * std::numbers::pi * uniform01(hash_key(1, i, 1));
    if (y < open_below) continue;
    const Vec3f normal(float(r * std::cos(a)), float(y), float(r * std::sin(a)));
    cloud.points.push_back(float(radius) * normal);
    cloud.normals.push_back(normal);
  }
  return cloud;
}

SurfaceOptions coarse() {
  SurfaceOptions options;
  options.poisson_depth = 6;
  return options;
}

TEST(PoissonSurface, FitsASphere) {
  const auto mesh = poisson::poisson_surface(sphere_points(5000, 0.05), coarse(), RunContext());
  ASSERT_TRUE(mesh) << mesh.error().text();
  for (const Vec3f& v : mesh->vertices) EXPECT_NEAR(v.norm(), 0.05f, 0.001f);
}

TEST(PoissonSurface, GivesTheSameBytesOnEveryRun) {
  const PointCloud points = sphere_points(5000, 0.05);
  const auto a = poisson::poisson_surface(points, coarse(), RunContext());
  const auto b = poisson::poisson_surface(points, coarse(), RunContext());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->vertices, b->vertices);
  EXPECT_EQ(a->triangles, b->triangles);
}

TEST(PoissonSurface, RefusesAHandfulOfPoints) {
  EXPECT_EQ(poisson::poisson_surface(sphere_points(5, 0.05), coarse(), RunContext()).error().code,
            ErrorCode::kTooFewPoints);
}

TEST(RepairPoisson, ClosesASphereOfWhichAFifthWasNotSeenWithoutABalloon) {
  const PointCloud points = sphere_points(5000, 0.05, -0.6);
  const auto raw = poisson::poisson_surface(points, coarse(), RunContext());
  ASSERT_TRUE(raw);
  const auto finished = repair_poisson(*raw, points, 0.004, Parts::kMain, RunContext());
  ASSERT_TRUE(finished) << finished.error().text();
  EXPECT_TRUE(finished->check.watertight());
  EXPECT_EQ(finished->check.components, 1);
  EXPECT_GT(finished->invented_area_m2, 0.001);
  EXPECT_LT(bounds(finished->mesh.vertices).size().maxCoeff(), 0.105);
}

TEST(RepairPoisson, DropsPiecesThatNoCandidateSupports) {
  const PointCloud points = sphere_points(5000, 0.05);
  auto raw = poisson::poisson_surface(points, coarse(), RunContext());
  ASSERT_TRUE(raw);
  TriangleMesh both = *raw;  // the same again, far away
  for (const Vec3f& v : raw->vertices) both.vertices.push_back(v + Vec3f(0.3f, 0, 0));
  const auto n = static_cast<std::uint32_t>(raw->vertices.size());
  for (const auto& t : raw->triangles) both.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const auto finished = repair_poisson(both, points, 0.004, Parts::kAll, RunContext());
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->check.components, 1);
  EXPECT_LT(bounds(finished->mesh.vertices).max.x(), 0.06);
}

TEST(RepairPoisson, KeepsPartsThatCandidatesSupportIfWanted) {
  const PointCloud one = sphere_points(5000, 0.05);
  const auto raw = poisson::poisson_surface(one, coarse(), RunContext());
  ASSERT_TRUE(raw);
  TriangleMesh both = *raw;
  PointCloud points = one;
  for (const Vec3f& p : one.points) points.points.push_back(p + Vec3f(0.15f, 0, 0));
  for (const Vec3f& v : raw->vertices) both.vertices.push_back(v + Vec3f(0.15f, 0, 0));
  const auto n = static_cast<std::uint32_t>(raw->vertices.size());
  for (const auto& t : raw->triangles) both.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const auto all = repair_poisson(both, points, 0.004, Parts::kAll, RunContext());
  const auto main = repair_poisson(both, points, 0.004, Parts::kMain, RunContext());
  ASSERT_TRUE(all && main);
  EXPECT_TRUE(all->check.watertight());
  EXPECT_EQ(all->check.components, 2);
  EXPECT_EQ(all->evidence.size(), all->mesh.triangles.size());
  EXPECT_EQ(main->check.components, 1);
}

TEST(ConcaveHull, BecomesWatertightWhenWrapped) {
  const PointCloud points = sphere_points(4000, 0.05);
  const auto raw = concave_hull(points, 0.006, RunContext());
  ASSERT_TRUE(raw) << raw.error().text();
  const auto finished = repair_concave_hull(*raw, points, 0.002, 0.006, Parts::kMain, RunContext());
  ASSERT_TRUE(finished) << finished.error().text();
  EXPECT_TRUE(finished->check.watertight());
  for (const Vec3f& v : finished->mesh.vertices) EXPECT_NEAR(v.norm(), 0.05f, 0.003f);
}

TEST(ColorVertices, TakesTheColourOfTheNearestCandidates) {
  PointCloud candidates;
  candidates.points = {Vec3f(0, 0, 0), Vec3f(1, 0, 0)};
  candidates.colors = {{255, 0, 0}, {0, 0, 255}};
  TriangleMesh mesh;
  mesh.vertices = {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0.5f, 0, 0)};
  color_vertices(mesh, candidates);
  EXPECT_EQ(mesh.colors[0], (Rgb{255, 0, 0}));
  EXPECT_EQ(mesh.colors[1], (Rgb{0, 0, 255}));
  EXPECT_EQ(mesh.colors[2], (Rgb{128, 0, 128}));
}

TEST(SurfaceOptions, RefuseValuesOutsideTheirRange) {
  SurfaceOptions options;
  EXPECT_FALSE(describe(options).set("poisson-depth", "14"));
  EXPECT_FALSE(describe(options).set("poisson-scale", "0.9"));
  EXPECT_FALSE(describe(options).set("poisson-samples", "0.5"));
  EXPECT_FALSE(describe(options).set("poisson-point-weight", "-1"));
  EXPECT_FALSE(describe(options).set("alpha", "0mm"));
  EXPECT_FALSE(describe(options).set("method", "ball-pivoting"));
}

}  // namespace
}  // namespace turnscan::surface
