#include <turnscan/reconstruction/quality/thin_walls.hpp>

#include <gtest/gtest.h>

#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan::quality {
namespace {

using test::append;
using test::sphere;
using test::torus;

std::size_t count_thinner(const TriangleMesh& mesh, double thickness_m) {
  const auto normals = vertex_normals(mesh);
  const ThinWalls walls(mesh, normals);
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    count += walls.thinner_than(thickness_m, v) ? 1 : 0;
  return count;
}

TEST(ThinWalls, AreThoseWhoseOtherSideIsNearer) {
  const TriangleMesh ring = torus(0.05, 0.004, 48, 16);
  EXPECT_EQ(count_thinner(ring, 0.007), 0u);
  EXPECT_EQ(count_thinner(ring, 0.009), ring.vertices.size());
  const TriangleMesh ball = sphere(0.05, 3);
  EXPECT_EQ(count_thinner(ball, 0.09), 0u);
  EXPECT_EQ(count_thinner(ball, 0.11), ball.vertices.size());
}

TEST(ThinWalls, AreNotWhereAnotherBodyBeginsBehindTheGap) {
  TriangleMesh two = sphere(0.05, 3);
  append(two, sphere(0.05, 3, Vec3d(0.12, 0.0, 0.0)));
  EXPECT_EQ(count_thinner(two, 0.09), 0u);
}

}  // namespace
}  // namespace turnscan::quality
