#include <gtest/gtest.h>

#include <turnscan/geometry/search/closest_point.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;
using Hit = MeshDistance::Hit;

Hit closest_by_brute_force(const TriangleMesh& mesh, const Vec3d& p) {
  Hit best;
  double best2 = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corner = [&](std::size_t c) {
      return Vec3d(mesh.vertices[mesh.triangles[t][c]].cast<double>());
    };
    const Vec3d q = closest_point_on_triangle(p, corner(0), corner(1), corner(2));
    if (!((q - p).squaredNorm() < best2)) continue;
    best2 = (q - p).squaredNorm();
    best = {q, t, std::sqrt(best2)};
  }
  return best;
}

Vec3d random_point(std::uint64_t seed, std::uint64_t i) {
  return {random_value(seed, i, 10), random_value(seed, i, 11), random_value(seed, i, 12)};
}

void expect_same_as_brute_force(const TriangleMesh& mesh, double reach) {
  const MeshDistance distance(mesh);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec3d p = i % 3 == 0 && !mesh.vertices.empty()
                        ? Vec3d(mesh.vertices[i % mesh.vertices.size()].cast<double>())
                        : Vec3d(reach * random_point(99, i));
    const Hit expected = closest_by_brute_force(mesh, p), hit = distance.closest(p);
    ASSERT_EQ(hit.triangle, expected.triangle);
    ASSERT_EQ(hit.distance, expected.distance);
    ASSERT_EQ(hit.point, expected.point);
  }
}

TEST(ClosestPoint, IsThatOfBruteForceOnManyMeshes) {
  expect_same_as_brute_force(tetrahedron(), 3.0);
  expect_same_as_brute_force(sphere(1.0, 3), 2.0);
  expect_same_as_brute_force(sphere(1.0, 3), 1e-3);
  expect_same_as_brute_force(plane(12), 2.0);
  for (const std::size_t n : {1, 2, 4, 5, 9, 300}) {
    expect_same_as_brute_force(random_soup(30, n, n), 2.0);
  }
}

TEST(ClosestPoint, OfATriangleNoPointOfItIsNearer) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vec3d a = random_point(1, i), b = random_point(2, i);
    // One in three triangles is a sliver, one in nine a segment, one in ... a point.
    Vec3d c = random_point(3, i);
    if (i % 3 == 1) c = a + (b - a) * 0.4 + c * 1e-9;
    if (i % 9 == 2) c = a;
    const Vec3d p = 3.0 * random_point(4, i);
    const Vec3d q = closest_point_on_triangle(p, a, b, c);
    double best = std::numeric_limits<double>::infinity();
    for (int u = 0; u <= 40; ++u) {
      for (int v = 0; u + v <= 40; ++v) {
        const Vec3d r = a + (b - a) * (u / 40.0) + (c - a) * (v / 40.0);
        best = std::min(best, (r - p).norm());
      }
    }
    ASSERT_LE((q - p).norm(), best + 1e-12) << "triangle " << i;
    ASSERT_GE((q - p).norm(), best - 0.1) << "triangle " << i;
  }
}

TEST(ClosestPoint, LiesInEachOfTheSevenRegions) {
  const Vec3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto closest = [&](double x, double y) {
    return closest_point_on_triangle(Vec3d(x, y, 2.0), a, b, c);
  };
  EXPECT_EQ(closest(-1, -1), a);
  EXPECT_EQ(closest(3, -1), b);
  EXPECT_EQ(closest(-1, 3), c);
  EXPECT_EQ(closest(0.25, -1), Vec3d(0.25, 0, 0));
  EXPECT_EQ(closest(-1, 0.25), Vec3d(0, 0.25, 0));
  EXPECT_EQ(closest(1, 1), Vec3d(0.5, 0.5, 0));
  EXPECT_EQ(closest(0.25, 0.25), Vec3d(0.25, 0.25, 0));
}

TEST(ClosestPoint, WithinAMaximumDistanceOnly) {
  const MeshDistance distance(plane(4));
  const Vec3d p(0.5, 0.25, 1.0);
  EXPECT_EQ(distance.closest(p, 0.999).triangle, MeshDistance::kNone);
  EXPECT_EQ(distance.closest(p, 1.0).distance, 1.0);
  EXPECT_EQ(distance.closest(p, 5.0).distance, 1.0);
}

TEST(ClosestPoint, OfNothingIsNone) {
  EXPECT_EQ(MeshDistance(TriangleMesh()).closest(Vec3d::Zero()).triangle, MeshDistance::kNone);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(MeshDistance(cube()).closest(Vec3d::Constant(nan)).triangle, MeshDistance::kNone);
  EXPECT_EQ(MeshDistance(cube()).closest(Vec3d::Zero(), nan).triangle, MeshDistance::kNone);
}

TEST(ClosestPoint, TrianglesThatAreNotValidAreLeftOut) {
  TriangleMesh mesh = cube();
  mesh.vertices.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f);
  mesh.triangles.insert(mesh.triangles.begin(), {{0, 1, 8}, {0, 1, 77}});
  const Hit hit = MeshDistance(mesh).closest(Vec3d(0.5, 0.5, 3.0));
  EXPECT_EQ(hit.distance, 2.0);
  EXPECT_EQ(hit.triangle, 4u) << "the first of the two triangles of the top, counted with all";
}

TEST(ClosestPoint, AMovedDistanceStillAnswers) {
  MeshDistance first(cube());
  const MeshDistance second = std::move(first);
  EXPECT_EQ(second.closest(Vec3d(0.5, 0.5, 3.0)).distance, 2.0);
}

TEST(MeshDistance, IsNotBuiltWhenCancelled) {
  const TriangleMesh mesh = sphere(1.0, 3);
  RunContext context;
  const auto built = MeshDistance::create(mesh, context);
  ASSERT_TRUE(built);
  EXPECT_EQ(built->closest(Vec3d(2, 0.1, 0.2)).triangle,
            MeshDistance(mesh).closest(Vec3d(2, 0.1, 0.2)).triangle);
  context.cancel();
  const auto none = MeshDistance::create(mesh, context);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
