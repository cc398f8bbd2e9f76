#include <gtest/gtest.h>

#include <turnscan/geometry/hull/convex_hull.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

TriangleMesh hull_of(const std::vector<Vec3f>& points) {
  TriangleMesh mesh;
  mesh.vertices = points;
  mesh.triangles = convex_hull(points);
  return mesh;
}

/// Closed, outward, and no point outside of any face.
void expect_hull(const TriangleMesh& hull, double tolerance) {
  TriangleMesh used = hull;
  ASSERT_FALSE(hull.empty());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : hull.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  for (const auto& t : hull.triangles) {
    const Vec3d a = hull.vertices[t[0]].cast<double>(), b = hull.vertices[t[1]].cast<double>(),
                c = hull.vertices[t[2]].cast<double>();
    const Vec3d normal = (b - a).cross(c - a).normalized();
    for (const Vec3f& p : hull.vertices) ASSERT_LE(normal.dot(p.cast<double>() - a), tolerance);
  }
  EXPECT_GT(signed_volume(hull), 0.0);
}

TEST(ConvexHull, HoldsAllPoints) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    std::vector<Vec3f> points;
    for (std::uint64_t i = 0; i < 2000; ++i)
      points.emplace_back(float(test::random_value(seed, i, 0)),
                          float(test::random_value(seed, i, 1)),
                          0.3f * float(test::random_value(seed, i, 2)));
    expect_hull(hull_of(points), 1e-5);
  }
}

TEST(ConvexHull, OfASubdividedCubeIsTheCube) {
  const TriangleMesh hull = hull_of(test::subdivided(test::cube(), 4).vertices);
  expect_hull(hull, 1e-5);
  EXPECT_NEAR(signed_volume(hull), 1.0, 1e-5);
}

TEST(ConvexHull, OfABallHasAllItsPoints) {
  const TriangleMesh ball = test::sphere(0.1, 5);
  const TriangleMesh hull = hull_of(ball.vertices);
  expect_hull(hull, 1e-6);
  EXPECT_EQ(hull.triangles.size(), ball.triangles.size());
}

TEST(ConvexHull, OfWhatIsFlatIsEmpty) {
  EXPECT_TRUE(convex_hull(test::plane(5).vertices).empty());
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_TRUE(convex_hull(std::vector<Vec3f>(10, Vec3f(1, 2, 3))).empty());
  std::vector<Vec3f> points = test::cube().vertices;
  points.emplace_back(std::nanf(""), 0.0f, 0.0f);
  EXPECT_TRUE(convex_hull(points).empty());
}

}  // namespace
}  // namespace turnscan
