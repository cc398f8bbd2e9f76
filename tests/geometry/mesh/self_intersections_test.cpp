#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/self_intersections.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

std::size_t marked(const SelfIntersections& found) {
  return std::size_t(std::count(found.triangles.begin(), found.triangles.end(), 1));
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto first = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [a, b, c] : more.triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
}

TEST(SelfIntersections, AreNoneOfSimpleShapes) {
  for (const TriangleMesh& mesh :
       {test::cube(), test::sphere(1.0, 4), test::torus(1.0, 0.3, 40, 20), TriangleMesh()}) {
    EXPECT_EQ(self_intersections(mesh).edges, 0u);
    EXPECT_EQ(marked(self_intersections(mesh)), 0u);
  }
}

TEST(SelfIntersections, AreAlongTheCircleWhereTwoSpheresMeetAndNowhereElse) {
  TriangleMesh both = test::sphere(1.0, 4);
  append(both, test::sphere(1.0, 4, Vec3d(0.0, 1.5, 0.0)));
  const auto found = self_intersections(both);
  EXPECT_GT(found.edges, 50u);
  for (std::size_t t = 0; t < found.triangles.size(); ++t) {
    const Vec3f p = both.vertices[both.triangles[t][0]];
    const float circle = std::hypot(std::hypot(p.x(), p.z()) - 0.6614f, p.y() - 0.75f);
    EXPECT_TRUE(!found.triangles[t] || circle < 0.2f) << t;
  }
  EXPECT_EQ(check_surface(both).crossing_edges, found.edges);
  EXPECT_THAT(check_surface(both).text(),
              ::testing::HasSubstr("edges that pass through other triangles"));
}

TEST(SelfIntersections, AreNoneOfShapesThatTouchOrContainEachOther) {
  TriangleMesh touching = test::cube();
  TriangleMesh beside = test::cube();
  const float side = float(bounds(beside.vertices).size().x());
  for (Vec3f& p : beside.vertices) p.x() += side;
  append(touching, beside);
  EXPECT_EQ(self_intersections(touching).edges, 0u);
  TriangleMesh hollow = test::sphere(1.0, 3);
  append(hollow, test::sphere(0.5, 3));
  EXPECT_EQ(self_intersections(hollow).edges, 0u);
}

TEST(SelfIntersections, IgnoreTrianglesThatAreNotThere) {
  TriangleMesh mesh = test::sphere(1.0, 2);
  mesh.triangles.push_back({0, 1, 100000});
  mesh.vertices.push_back(Vec3f::Constant(std::nanf("")));
  mesh.triangles.push_back({0, 1, std::uint32_t(mesh.vertices.size() - 1)});
  EXPECT_EQ(self_intersections(mesh).edges, 0u);
}

/// Whether a segment passes through a triangle: in whole numbers, without rounding.
bool plainly_passes(const std::array<std::array<long, 3>, 5>& p) {
  const auto volume = [&](int a, int b, int c, int d) {
    long m[3][3];
    for (int k = 0; k < 3; ++k) {
      m[0][k] = p[std::size_t(b)][std::size_t(k)] - p[std::size_t(a)][std::size_t(k)];
      m[1][k] = p[std::size_t(c)][std::size_t(k)] - p[std::size_t(a)][std::size_t(k)];
      m[2][k] = p[std::size_t(d)][std::size_t(k)] - p[std::size_t(a)][std::size_t(k)];
    }
    const long v = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return v > 0 ? 1 : v < 0 ? -1 : 0;
  };
  const int u = volume(0, 1, 2, 3), v = volume(0, 1, 3, 4), w = volume(0, 1, 4, 2);
  return volume(2, 3, 4, 0) * volume(2, 3, 4, 1) < 0 &&
         ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0));
}

TEST(SelfIntersections, OfRandomTrianglesAreThoseOfAPlainLoopOverAllPairs) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    const int side = round % 2 == 0 ? 6 : 100;  // with many and without degenerate cases
    TriangleMesh mesh;
    for (int v = 0; v < 60; ++v)
      mesh.vertices.emplace_back(float(random() % unsigned(side)), float(random() % unsigned(side)),
                                 float(random() % unsigned(side)));
    for (int t = 0; t < 40; ++t) {
      const auto a = std::uint32_t(random() % 60);
      mesh.triangles.push_back({a, std::uint32_t((a + 1 + random() % 20) % 60),
                                std::uint32_t((a + 21 + random() % 30) % 60)});
    }
    std::vector<std::uint8_t> expected(mesh.triangles.size(), 0);
    for (std::size_t s = 0; s < mesh.triangles.size(); ++s)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
          const auto& [x, y, z] = mesh.triangles[t];
          const std::uint32_t a = mesh.triangles[s][c], b = mesh.triangles[s][(c + 1) % 3];
          if (a == x || a == y || a == z || b == x || b == y || b == z) continue;
          std::array<std::array<long, 3>, 5> points;
          std::size_t n = 0;
          for (const std::uint32_t v : {a, b, x, y, z}) {
            const Vec3f& p = mesh.vertices[v];
            points[n++] = {long(p.x()), long(p.y()), long(p.z())};
          }
          if (plainly_passes(points)) expected[s] = expected[t] = 1;
        }
    EXPECT_EQ(self_intersections(mesh).triangles, expected) << "round " << round;
  }
}

}  // namespace
}  // namespace turnscan
