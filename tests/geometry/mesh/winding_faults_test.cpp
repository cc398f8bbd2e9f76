#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/geometry/mesh/winding_faults.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

std::size_t marked(const std::vector<std::uint8_t>& faults) {
  return std::size_t(std::count(faults.begin(), faults.end(), 1));
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto first = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [a, b, c] : more.triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
}

TEST(WindingFaults, AreNoneOfSimpleShapesWhateverTheSpacing) {
  for (const double spacing : {0.011, 0.05, 0.25, 0.5}) {
    EXPECT_EQ(marked(winding_faults(test::cube(), spacing)), 0u);  // rays hit edges of its faces
    EXPECT_EQ(marked(winding_faults(test::sphere(1.0, 4), spacing)), 0u);
    EXPECT_EQ(marked(winding_faults(test::torus(1.0, 0.3, 40, 20), spacing)), 0u);
  }
  EXPECT_TRUE(winding_faults({}, 0.1).empty());
}

TEST(WindingFaults, AreWhereShapesOverlap) {
  TriangleMesh both = test::sphere(1.0, 4);
  append(both, test::sphere(1.0, 4, Vec3d(0.0, 1.5, 0.0)));
  const auto faults = winding_faults(both, 0.05);
  std::size_t within = 0;
  for (std::size_t t = 0; t < faults.size(); ++t) {
    const Vec3f p = both.vertices[both.triangles[t][0]];
    const bool other = t >= faults.size() / 2;
    const bool overlaps = (p - Vec3f(0.0f, other ? 0.0f : 1.5f, 0.0f)).norm() < 1.1f;
    within += overlaps ? 1 : 0;
    if (faults[t]) {
      EXPECT_TRUE(overlaps) << p.transpose();
    }
  }
  EXPECT_GT(marked(faults), within * 7 / 10);
}

TEST(WindingFaults, AreNoneOfShapesBesideAndOfHollowsWithinEachOther) {
  TriangleMesh apart = test::sphere(1.0, 3);
  append(apart, test::sphere(1.0, 3, Vec3d(0.0, 2.5, 0.0)));
  EXPECT_EQ(marked(winding_faults(apart, 0.05)), 0u);
  TriangleMesh hollow = test::sphere(1.0, 3), inner = test::sphere(0.5, 3);
  for (auto& t : inner.triangles) std::swap(t[0], t[1]);
  append(hollow, inner);
  EXPECT_EQ(marked(winding_faults(hollow, 0.05)), 0u);
}

TEST(WindingFaults, AreAllOfAShapeTurnedInsideOut) {
  TriangleMesh mesh = test::sphere(1.0, 2);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(marked(winding_faults(mesh, 0.01)), mesh.triangles.size());
}

}  // namespace
}  // namespace turnscan
