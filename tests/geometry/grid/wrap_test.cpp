#include <gtest/gtest.h>

#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/wrap.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

TriangleMesh wrapped(const TriangleMesh& mesh, double cell_m) {
  const auto result = grid::wrap(mesh, cell_m, RunContext());
  if (!result) {
    ADD_FAILURE() << result.error().text();
    return {};
  }
  const MeshReport report = check_mesh(*result);
  EXPECT_TRUE(report.watertight()) << report.text();
  return *result;
}

double farthest(const TriangleMesh& from, const TriangleMesh& to) {
  const MeshDistance distance(to);
  double farthest = 0.0;
  for (const Vec3f& v : from.vertices) {
    farthest = std::max(farthest, distance.closest(v.cast<double>()).distance);
  }
  return farthest;
}

TEST(Wrap, LiesOnTheSurfaceItWraps) {
  const TriangleMesh mesh = sphere(1.0, 5);
  const TriangleMesh result = wrapped(mesh, 0.05);
  EXPECT_LT(farthest(result, mesh), 0.03 * 0.05);
  EXPECT_LT(farthest(mesh, result), 0.1 * 0.05);
  EXPECT_NEAR(check_mesh(result).volume_m3, check_mesh(mesh).volume_m3, 0.02);
  EXPECT_EQ(check_mesh(result).euler, 2);
}

TEST(Wrap, KeepsEdgesAndCornersOfABox) {
  const TriangleMesh result = wrapped(cube(), 0.04);
  EXPECT_NEAR(check_mesh(result).volume_m3, 1.0, 0.01);
  EXPECT_NEAR(check_mesh(result).area_m2, 6.0, 0.05);
  const Box box = bounds(result.vertices);
  EXPECT_NEAR(box.max.x(), 1.0, 0.001);
  EXPECT_LT(farthest(cube(), result), 0.002) << "the corners are reached";
}

TEST(Wrap, GoesIntoTheHoleOfATorus) {
  const TriangleMesh mesh = torus(1.0, 0.3, 60, 30);
  const TriangleMesh result = wrapped(mesh, 0.013);
  EXPECT_EQ(check_mesh(result).euler, 0);
  EXPECT_NEAR(check_mesh(result).volume_m3, check_mesh(mesh).volume_m3, 0.02);
}

TEST(Wrap, DoesNotMindFlippedDoubledAndLooseTriangles) {
  TriangleMesh mesh = subdivided(cube(), 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (random_value(1, t) > 0.0) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  }
  const std::size_t n = mesh.triangles.size();
  for (std::size_t t = 0; t < n; t += 3) mesh.triangles.push_back(mesh.triangles[t]);
  // Walls inside, as a concave hull has: edges of three triangles.
  mesh.vertices.emplace_back(0.5f, 0.5f, 0.5f);
  const auto center = std::uint32_t(mesh.vertices.size() - 1);
  for (std::size_t t = 0; t < n; t += 7) {
    mesh.triangles.push_back({mesh.triangles[t][0], mesh.triangles[t][1], center});
  }
  const TriangleMesh result = wrapped(as_soup(mesh), 0.05);
  EXPECT_EQ(check_mesh(result).components, 1);
  EXPECT_NEAR(check_mesh(result).volume_m3, 1.0, 0.02);
}

/// A box whose lid is open by a slit of some width.
TriangleMesh box_with_slit(float width) {
  TriangleMesh box = cube();
  box.triangles.erase(box.triangles.begin() + 2, box.triangles.begin() + 4);
  for (const float side : {0.0f, 1.0f}) {
    TriangleMesh half = plane(1);
    for (Vec3f& v : half.vertices) {
      v.x() =
          side == 0.0f ? v.x() * (0.5f - width / 2) : 0.5f + width / 2 + v.x() * (0.5f - width / 2);
      v.z() = 1.0f;
    }
    append(box, half);
  }
  return box;
}

TEST(Wrap, ClosesSmallGapsAndNotLargeOnes) {
  const TriangleMesh closed = wrapped(box_with_slit(0.04f), 0.04);
  EXPECT_NEAR(check_mesh(closed).volume_m3, 1.0, 0.02) << "filled behind a gap of one cell";
  const TriangleMesh hollow = wrapped(box_with_slit(0.2f), 0.04);
  EXPECT_LT(check_mesh(hollow).volume_m3, 0.2) << "a shell where the gap is five cells wide";
}

TEST(Wrap, AnOpenSheetBecomesAThinPlate) {
  const TriangleMesh result = wrapped(plane(4), 0.05);
  EXPECT_LT(check_mesh(result).volume_m3, 0.01);
  EXPECT_GT(check_mesh(result).volume_m3, 0.0);
  EXPECT_NEAR(check_mesh(result).area_m2, 2.0, 0.05);
}

TEST(Wrap, PiecesFarApartStayApart) {
  TriangleMesh mesh = sphere(1.0, 3);
  append(mesh, sphere(0.5, 3, Vec3d(3, 0, 0)));
  EXPECT_EQ(check_mesh(wrapped(mesh, 0.1)).components, 2);
}

TEST(Wrap, IsWatertightAroundAnySoup) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const TriangleMesh soup = random_soup(3 + seed, 1 + 2 * seed, seed);
    if (check_mesh(soup).area_m2 == 0.0) continue;
    wrapped(soup, 0.07 + 0.01 * double(seed % 7));
  }
}

TEST(Wrap, IsTheSameForOneAndTwoThreads) {
  TriangleMesh mesh = random_soup(40, 80, 5);
  set_thread_count(1);
  const auto one = grid::wrap(mesh, 0.05, RunContext());
  set_thread_count(2);
  const auto two = grid::wrap(mesh, 0.05, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->vertices, two->vertices);
  EXPECT_EQ(one->triangles, two->triangles);
}

TEST(Wrap, FailsByName) {
  const RunContext context;
  EXPECT_EQ(grid::wrap(TriangleMesh(), 0.1, context).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(grid::wrap(cube(), -1.0, context).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(grid::wrap(cube(), 1e-5, context).error().code, ErrorCode::kResourceLimit);
  TriangleMesh mesh = cube();
  mesh.vertices[0].x() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(grid::wrap(mesh, 0.1, context).error().code, ErrorCode::kFormat);
  mesh = cube();
  mesh.triangles[0][1] = 99;
  EXPECT_EQ(grid::wrap(mesh, 0.1, context).error().code, ErrorCode::kFormat);
  context.cancel();
  EXPECT_EQ(grid::wrap(cube(), 0.1, context).error().code, ErrorCode::kCancelled);
}

TEST(Wrap, StopsWhenCancelledFromWithin) {
  RunContext context;
  context.set_listener([&](const Progress& progress) {
    if (progress.phase == "wrap") context.cancel();
  });
  EXPECT_EQ(grid::wrap(cube(), 0.1, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
