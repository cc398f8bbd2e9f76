#include <turnscan/geometry/selection/selection.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

Selection random_selection(std::size_t count, std::uint64_t seed, double share) {
  Selection out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = uniform01(hash_key(seed, i, 77)) < share ? 1 : 0;
  return out;
}

Selection one_of(std::size_t count, std::size_t which) {
  Selection out(count, 0);
  out[which] = 1;
  return out;
}

bool contains(const Selection& all, const Selection& part) {
  for (std::size_t i = 0; i < part.size(); ++i)
    if (part[i] != 0 && all[i] == 0) return false;
  return true;
}

TEST(SelectionChange, AddsSubtractsAndReplaces) {
  const Selection a{1, 1, 0, 0}, b{1, 0, 1, 0};
  Selection s = a;
  change_selection(s, b, SelectHow::kAdd);
  EXPECT_EQ(s, (Selection{1, 1, 1, 0}));
  s = a;
  change_selection(s, b, SelectHow::kSubtract);
  EXPECT_EQ(s, (Selection{0, 1, 0, 0}));
  change_selection(s, b, SelectHow::kReplace);
  EXPECT_EQ(s, b);
  Selection none;
  change_selection(none, b, SelectHow::kSubtract);
  EXPECT_EQ(count_selected(none), 0u);
  EXPECT_EQ(none.size(), 4u);
  EXPECT_EQ(inverted(b), (Selection{0, 1, 0, 1}));
  EXPECT_THROW(change_selection(s, {1}, SelectHow::kAdd), std::invalid_argument);
}

TEST(SelectionGrow, AddsExactlyTheTrianglesThatShareAVertex) {
  const TriangleMesh ring = torus(0.05, 0.02, 24, 12);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Selection start = random_selection(ring.triangles.size(), seed, 0.02);
    const Selection made = grown(ring, start);
    for (std::size_t t = 0; t < made.size(); ++t) {
      bool neighbour = false;
      for (std::size_t u = 0; u < made.size(); ++u)
        for (const std::uint32_t v : ring.triangles[t])
          for (const std::uint32_t w : ring.triangles[u])
            neighbour = neighbour || (start[u] != 0 && v == w);
      ASSERT_EQ(made[t] != 0, neighbour) << seed << " " << t;
    }
  }
}

TEST(SelectionGrow, ThenShrinkContainsTheStart) {
  const TriangleMesh ring = torus(0.05, 0.02, 40, 24);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Selection start = random_selection(ring.triangles.size(), seed, 0.05);
    EXPECT_TRUE(contains(shrunk(ring, grown(ring, start)), start));
    EXPECT_TRUE(contains(start, shrunk(ring, start)));
  }
}

TEST(SelectionConnected, TakesWholePiecesAndNoOthers) {
  TriangleMesh three = sphere(0.01, 2);
  const std::size_t each = three.triangles.size();
  append(three, sphere(0.01, 2, Vec3d(0.05, 0, 0)));
  append(three, sphere(0.01, 2, Vec3d(0.10, 0, 0)));
  const Selection made = connected(three, one_of(3 * each, each + 5));
  for (std::size_t t = 0; t < made.size(); ++t) EXPECT_EQ(made[t] != 0, t / each == 1) << t;
  EXPECT_EQ(count_selected(connected(three, Selection(3 * each, 0))), 0u);
}

TEST(SelectionSmallPieces, AreThoseBelowTheShareOfTheLargest) {
  TriangleMesh mesh = sphere(0.05, 3);
  const std::size_t large = mesh.triangles.size();
  append(mesh, sphere(0.01, 2, Vec3d(0.10, 0, 0)));  // 4 % of the area
  append(mesh, sphere(0.02, 1, Vec3d(0, 0.10, 0)));  // 16 %
  append(mesh, sphere(0.002, 1, Vec3d(0, 0, 0.10)));
  const std::size_t second = large + sphere(0.01, 2).triangles.size();
  const std::size_t third = second + sphere(0.02, 1).triangles.size();
  const auto found = small_pieces(mesh, 0.05);
  EXPECT_EQ(found.pieces, 2u);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_EQ(found.parts[t] != 0, (t >= large && t < second) || t >= third) << t;
  EXPECT_EQ(small_pieces(mesh, 0.2).pieces, 3u);
  EXPECT_EQ(small_pieces(TriangleMesh(), 0.05).pieces, 0u);
}

TEST(SelectionSmallPieces, OfPointsAreCountedByTheirNumber) {
  std::vector<Vec3f> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(0.001f * float(i), 0.0f, 0.0f);
  for (int i = 0; i < 4; ++i) points.emplace_back(0.001f * float(i), 0.1f, 0.0f);
  for (int i = 0; i < 30; ++i) points.emplace_back(0.001f * float(i), 0.2f, 0.0f);
  const auto found = small_pieces(points, 0.05, 0.0015);
  EXPECT_EQ(found.pieces, 1u);
  EXPECT_EQ(count_selected(found.parts), 4u);
  EXPECT_TRUE(found.parts[100] != 0 && found.parts[103] != 0);
  EXPECT_EQ(small_pieces(points, 0.05, 1.0).pieces, 0u) << "one piece";
}

TEST(SelectionConnected, IsWhatGrowingForeverGives) {
  TriangleMesh two = torus(0.05, 0.02, 12, 8);
  append(two, sphere(0.01, 1, Vec3d(1, 0, 0)));
  Selection growing = one_of(two.triangles.size(), 3);
  for (std::size_t i = 0; i < two.triangles.size(); ++i) growing = grown(two, growing);
  EXPECT_EQ(connected(two, one_of(two.triangles.size(), 3)), growing);
}

TEST(SelectionOfPoints, GrowsByTheReachAndFollowsItToTheEnd) {
  // Two rows, 1 mm between points, 5 mm between the rows.
  std::vector<Vec3f> points;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < 50; ++i) points.emplace_back(0.001f * float(i), 0.005f * float(row), 0.0f);
  points.emplace_back(std::nanf(""), 0.0f, 0.0f);
  EXPECT_NEAR(usual_reach(points), 0.002, 1e-6);
  const Selection start = one_of(points.size(), 10);
  const Selection once = grown(points, start, 0.0015);
  EXPECT_EQ(count_selected(once), 3u);
  EXPECT_TRUE(once[9] != 0 && once[10] != 0 && once[11] != 0);
  EXPECT_EQ(shrunk(points, once, 0.0015), start);
  const Selection all = connected(points, start, 0.0015);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(all[i] != 0, i < 50) << i;
  EXPECT_EQ(usual_reach({}), 0.0);
}

}  // namespace
}  // namespace turnscan
