#include <gtest/gtest.h>

#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

std::vector<std::uint8_t> within(const TriangleMesh& mesh, const Vec3f& center, float radius) {
  std::vector<std::uint8_t> inside(mesh.vertices.size());
  for (std::size_t v = 0; v < inside.size(); ++v) {
    inside[v] = (mesh.vertices[v] - center).norm() < radius;
  }
  return inside;
}

void blow_up(TriangleMesh& mesh, const std::vector<std::uint8_t>& where, std::uint64_t seed) {
  for (std::size_t v = 0; v < where.size(); ++v) {
    if (where[v] == 0) continue;
    mesh.vertices[v] += Vec3f(float(random_value(seed, v, 0)), float(random_value(seed, v, 1)),
                              3.0f + float(random_value(seed, v, 2)));
  }
}

RelaxOptions tight(double tension) {
  RelaxOptions options;
  options.tension = tension;
  return options;
}

TEST(Relax, ContinuesAPlaneExactly) {
  for (const double tension : {0.0, 0.3, 1.0}) {
    TriangleMesh mesh = plane(40);
    const TriangleMesh flat = mesh;
    const auto movable = within(mesh, Vec3f(0.5f, 0.5f, 0.0f), 0.3f);
    blow_up(mesh, movable, 1);
    const auto relaxed = relax(mesh, movable, tight(tension), RunContext());
    ASSERT_TRUE(relaxed) << relaxed.error().text();
    EXPECT_EQ(relaxed->triangles, mesh.triangles);
    for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
      ASSERT_LT((relaxed->vertices[v] - flat.vertices[v]).norm(), 1e-5f) << tension;
    }
  }
}

TEST(Relax, APlateContinuesTheCurvatureOfASphereAndAFilmDoesNot) {
  TriangleMesh mesh = sphere(1.0, 5);
  const Vec3f pole = Vec3f(1, 1, 1).normalized();  // where the mesh is most regular
  const auto movable = within(mesh, pole, 0.5f);
  blow_up(mesh, movable, 2);
  const auto height = [&](double tension) {
    const auto relaxed = relax(mesh, movable, tight(tension), RunContext());
    float top = 0.0f;
    for (const Vec3f& v : relaxed->vertices) top = std::max(top, v.dot(pole));
    return top;
  };
  // Not exactly 1: uniform weights take the mesh's vertices for evenly spaced, which they are not.
  EXPECT_NEAR(height(0.0), 1.0f, 0.04f);
  EXPECT_NEAR(height(1.0), 0.875f, 0.01f) << "the rim of the cap, at distance 0.5 of the pole";
  EXPECT_LT(height(0.5), height(0.0));
}

TEST(Relax, LeavesFixedVerticesAlone) {
  TriangleMesh mesh = sphere(1.0, 4);
  const auto movable = within(mesh, Vec3f(0, 0, 1), 0.5f);
  const auto relaxed = relax(mesh, movable, {}, RunContext());
  ASSERT_TRUE(relaxed);
  for (std::size_t v = 0; v < movable.size(); ++v) {
    if (movable[v] != 0) continue;
    ASSERT_EQ(relaxed->vertices[v], mesh.vertices[v]);
  }
}

TEST(Relax, SolvesRegionsApartAndLeavesWhatNothingHolds) {
  TriangleMesh mesh = plane(30);
  TriangleMesh loose = sphere(1.0, 2, Vec3d(5, 5, 5));
  auto movable = within(mesh, Vec3f(0.25f, 0.25f, 0.0f), 0.1f);
  const auto other = within(mesh, Vec3f(0.75f, 0.75f, 0.0f), 0.1f);
  for (std::size_t v = 0; v < movable.size(); ++v) movable[v] |= other[v];
  blow_up(mesh, movable, 3);
  append(mesh, loose);
  movable.resize(mesh.vertices.size(), 1);
  mesh.vertices.emplace_back(9.0f, 9.0f, 9.0f);  // named by nothing
  movable.push_back(1);
  const auto relaxed = relax(mesh, movable, {}, RunContext());
  ASSERT_TRUE(relaxed);
  for (std::size_t v = 0; v < plane(30).vertices.size(); ++v) {
    ASSERT_NEAR(relaxed->vertices[v].z(), 0.0f, 1e-5f);
  }
  for (std::size_t v = plane(30).vertices.size(); v < mesh.vertices.size(); ++v) {
    ASSERT_EQ(relaxed->vertices[v], mesh.vertices[v]);
  }
}

TEST(Relax, RegionsThatTouchTheSameFixedVertexAreSolvedTogether) {
  TriangleMesh mesh = plane(30);
  std::vector<std::uint8_t> movable = within(mesh, Vec3f(0.5f, 0.5f, 0.0f), 0.3f);
  for (std::size_t v = 0; v < movable.size(); ++v) {
    // A line of fixed vertices one vertex wide parts two regions.
    if (std::abs(mesh.vertices[v].x() - 0.5f) < 0.01f) movable[v] = 0;
  }
  blow_up(mesh, movable, 4);
  const auto relaxed = relax(mesh, movable, {}, RunContext());
  ASSERT_TRUE(relaxed) << relaxed.error().text();
  for (const Vec3f& v : relaxed->vertices) ASSERT_NEAR(v.z(), 0.0f, 1e-5f);
}

TEST(Relax, SurvivesSliversFoldsAndHubs) {
  TriangleMesh mesh = plane(60);
  auto movable = within(mesh, Vec3f(0.5f, 0.5f, 0.0f), 0.4f);
  for (std::size_t v = 0; v < movable.size(); ++v) {
    // All movable vertices on one place or one line: triangles without area, folded over.
    if (movable[v] != 0) mesh.vertices[v] = Vec3f(0.5f, 0.5f, v % 3 == 0 ? 1.0f : 0.0f);
  }
  // A hub: a disc of 3000 triangles around one movable vertex.
  const auto first = std::uint32_t(mesh.vertices.size());
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const double u = 2.0 * std::numbers::pi * i / 3000;
    mesh.vertices.push_back(Vec3d(std::cos(u), std::sin(u), 5.0).cast<float>());
    mesh.triangles.push_back({first + i, first + (i + 1) % 3000, first + 3000});
  }
  mesh.vertices.emplace_back(0.0f, 0.0f, 9.0f);
  movable.resize(mesh.vertices.size(), 0);
  movable.back() = 1;
  const auto relaxed = relax(mesh, movable, {}, RunContext());
  ASSERT_TRUE(relaxed) << relaxed.error().text();
  EXPECT_EQ(check_mesh(*relaxed).invalid_triangles, 0u);
  EXPECT_NEAR(relaxed->vertices.back().z(), 5.0f, 1e-5f);
  for (std::uint32_t v = 0; v < first; ++v) ASSERT_NEAR(relaxed->vertices[v].z(), 0.0f, 1e-4f);
}

TEST(Relax, IsTheSameForOneAndTwoThreads) {
  TriangleMesh mesh = plane(60);
  auto movable = within(mesh, Vec3f(0.25f, 0.25f, 0.0f), 0.2f);
  const auto other = within(mesh, Vec3f(0.75f, 0.75f, 0.0f), 0.2f);
  for (std::size_t v = 0; v < movable.size(); ++v) movable[v] |= other[v];
  for (Vec3f& v : mesh.vertices) v.z() = std::sin(5.0f * v.x()) * v.y();
  set_thread_count(1);
  const auto one = relax(mesh, movable, tight(0.1), RunContext());
  set_thread_count(2);
  const auto two = relax(mesh, movable, tight(0.1), RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->vertices, two->vertices);
}

TEST(Relax, FailsByName) {
  const TriangleMesh mesh = plane(4);
  const std::vector<std::uint8_t> movable(mesh.vertices.size(), 0);
  EXPECT_EQ(relax(mesh, {1, 0}, {}, RunContext()).error().code, ErrorCode::kInvalidOption);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(relax(mesh, movable, tight(nan), RunContext()).error().code, ErrorCode::kInvalidOption);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(relax(mesh, movable, {}, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
