#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

double side_of(const TriangleMesh& mesh, const MeshDistance& distance, const Vec3d& p) {
  const auto hit = distance.closest(p);
  return (p - hit.point).dot(PseudoNormals(mesh).at(hit.point, hit.triangle));
}

TEST(PseudoNormals, TellInsideFromOutsideBesideSharpEdgesAndCorners) {
  // A spike: beside its tip and edges the normal of one face alone has the wrong sign.
  TriangleMesh spike;
  spike.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5f, 0, 1}, {0.5f, 8, 0.5f}};
  spike.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  const MeshDistance distance(spike);
  const auto inside = [&](const Vec3d& p) {
    for (const auto& t : spike.triangles) {
      const Vec3d a = spike.vertices[t[0]].cast<double>();
      const Vec3d n =
          (spike.vertices[t[1]].cast<double>() - a).cross(spike.vertices[t[2]].cast<double>() - a);
      if (n.dot(p - a) > 0.0) return false;
    }
    return true;
  };
  ASSERT_TRUE(inside({0.5, 1.0, 0.4}));
  std::size_t within = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto u = [i](std::uint64_t axis) { return uniform01(hash_key(3, i, axis)); };
    const Vec3d p(-0.5 + 2.0 * u(0), -2.0 + 12.0 * u(1), -0.5 + 2.0 * u(2));
    within += inside(p) ? 1 : 0;
    ASSERT_EQ(side_of(spike, distance, p) < 0.0, inside(p)) << p.transpose();
  }
  EXPECT_GT(within, 20u);
}

TEST(PseudoNormals, OfFaceEdgeAndVertexOfACube) {
  const TriangleMesh cube = test::cube();
  const PseudoNormals normals(cube);
  const MeshDistance distance(cube);
  const auto at = [&](const Vec3d& p) {
    const auto hit = distance.closest(p);
    return normals.at(hit.point, hit.triangle);
  };
  EXPECT_TRUE(at({0.3, 0.4, 2.0}).isApprox(Vec3d(0, 0, 1), 1e-6));
  EXPECT_TRUE(at({2.0, 0.4, 2.0}).isApprox(Vec3d(1, 0, 1).normalized(), 1e-6));
  EXPECT_TRUE(at({2.0, 2.0, 2.0}).isApprox(Vec3d(1, 1, 1).normalized(), 1e-6));
}

TEST(PseudoNormals, AreZeroWhereFacesHaveNoArea) {
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(PseudoNormals(flat).at({0.5, 0, 0}, 0), Vec3d::Zero());
}

TEST(PseudoNormals, AreNotMadeWhenCancelled) {
  RunContext context;
  EXPECT_TRUE(PseudoNormals::create(test::tetrahedron(), context));
  context.cancel();
  const auto none = PseudoNormals::create(test::tetrahedron(), context);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
