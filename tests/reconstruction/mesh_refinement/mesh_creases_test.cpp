#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <tests/reconstruction/mesh_refinement/ball_mesh.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_creases.hpp>

namespace turnscan::mesh_refinement {
namespace {

constexpr int kSide = 48;
constexpr double kCell_m = 0.001;

using Distance = std::function<double(const Vec3d&)>;

/// The zero set of a signed distance about the middle of a cube of 48 mm, cut from cells of 1 mm,
/// its vertices displaced along their normals by noise.
TriangleMesh extracted(const Distance& distance, double noise_m) {
  BrickGrid grid = *BrickGrid::create(Vec3d::Constant(-0.5 * kSide * kCell_m), kCell_m,
                                      {kSide, kSide, kSide}, 1.0f, std::size_t(1) << 24);
  std::vector<std::size_t> all(grid.brick_count());
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = b;
  EXPECT_TRUE(grid.allocate(all));
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const Vec3d p = kCell_m * (Vec3d(i, j, k) - Vec3d::Constant(0.5 * kSide));
        grid.samples(grid.brick_index(
            i / 8, j / 8, k / 8))[BrickGrid::within(i % 8, j % 8, k % 8)] = float(distance(p));
      }
  TriangleMesh mesh = *isosurface(grid, MarchingCells::kCubes, RunContext());
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertices[v] += float(noise_m * standard_normal(hash_key(5, v))) * normals[v];
  return mesh;
}

const Eigen::Quaterniond kTilted(Eigen::AngleAxisd(0.5, Vec3d(0.4, 1.0, 0.2).normalized()));

/// Largest norm of the distances from a cube of 30 mm, turned against the cells.
double cube(const Vec3d& p) { return (kTilted * p).cwiseAbs().maxCoeff() - 0.015; }

/// From the middle of an edge: root mean square and mean of what vertices lie off the cube, of
/// those within 1.2 mm of an edge and farther than 6 mm from its ends.
struct OffEdges {
  double rms_m, mean_m;
};
OffEdges off_edges(const TriangleMesh& mesh, const Distance& distance) {
  double squares = 0.0, sum = 0.0, count = 0.0;
  for (const Vec3f& vertex : mesh.vertices) {
    const Vec3d p = vertex.cast<double>();
    Vec3d q = (kTilted * p).cwiseAbs();
    std::sort(q.data(), q.data() + 3);
    if (q[0] > 0.009 || std::hypot(q[1] - 0.015, q[2] - 0.015) > 0.0012) continue;
    const double d = distance(p);
    squares += d * d, sum += d, count += 1.0;
  }
  EXPECT_GT(count, 100.0);
  return {std::sqrt(squares / count), sum / count};
}

std::vector<float> measured(const TriangleMesh& mesh) {
  return std::vector<float>(mesh.vertices.size(), 10.0f);
}

double largest_motion(const TriangleMesh& a, const TriangleMesh& b) {
  double out = 0.0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    out = std::max(out, double((a.vertices[v] - b.vertices[v]).norm()));
  return out;
}

TEST(Creases, EdgesThatWereCutOffBecomeStraightAndSharp) {
  for (const double noise_m : {0.0, 0.0001}) {
    TriangleMesh mesh = extracted(cube, noise_m);
    const OffEdges before = off_edges(mesh, cube);
    ASSERT_TRUE(straighten_creases(mesh, measured(mesh), RunContext()));
    const OffEdges after = off_edges(mesh, cube);
    EXPECT_LT(before.mean_m, -0.00001) << noise_m;
    EXPECT_LT(after.rms_m, 0.5 * before.rms_m) << noise_m;
    EXPECT_LT(std::abs(after.mean_m), 0.00003) << noise_m;
    EXPECT_TRUE(check_mesh(mesh).watertight());
  }
}

TEST(Creases, GroovesAreNoEdges) {
  // What is outside of the cube, within a ball.
  const auto hollow = [](const Vec3d& p) { return std::max(p.norm() - 0.0225, -cube(p / 0.75)); };
  const auto wall = [](const Vec3d& p) { return -0.75 * cube(p / 0.75); };
  TriangleMesh mesh = extracted(hollow, 0.00005);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(straighten_creases(mesh, measured(mesh), RunContext()));
  double was = 0.0, is = 0.0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3d p = before.vertices[v].cast<double>(), q = mesh.vertices[v].cast<double>();
    if (p.norm() > 0.0175) continue;
    was += std::pow(wall(p), 2), is += std::pow(wall(q), 2);
  }
  EXPECT_LT(is, 0.8 * was);
}

TEST(Creases, RoundSurfaceStays) {
  const TriangleMesh ball = testing::ball_mesh();
  TriangleMesh mesh = ball;
  ASSERT_TRUE(straighten_creases(mesh, measured(mesh), RunContext()));
  EXPECT_EQ(largest_motion(mesh, ball), 0.0);

  // Rings of 6 mm: as narrow as the neighbourhoods in which creases are looked for.
  const auto torus = [](const Vec3d& p) {
    return std::hypot(std::hypot(p.x(), p.z()) - 0.015, p.y()) - 0.003;
  };
  const TriangleMesh ring = extracted(torus, 0.00005);
  mesh = ring;
  ASSERT_TRUE(straighten_creases(mesh, measured(mesh), RunContext()));
  EXPECT_EQ(largest_motion(mesh, ring), 0.0);
}

TEST(Creases, WhatWasNotMeasuredStays) {
  const TriangleMesh before = extracted(cube, 0.0001);
  std::vector<float> support = measured(before);
  for (std::size_t v = 0; v < support.size(); ++v)
    if (before.vertices[v].y() < 0.0f) support[v] = 0.0f;
  TriangleMesh mesh = before;
  ASSERT_TRUE(straighten_creases(mesh, support, RunContext()));
  std::size_t moved = 0;
  for (std::size_t v = 0; v < support.size(); ++v) {
    const bool moves = mesh.vertices[v] != before.vertices[v];
    EXPECT_FALSE(moves && support[v] == 0.0f) << v;
    moved += moves ? 1 : 0;
  }
  EXPECT_GT(moved, 100u);
}

TEST(Creases, NothingMovesOnceItIsCancelled) {
  const TriangleMesh before = extracted(cube, 0.0);
  TriangleMesh mesh = before;
  RunContext context;
  context.cancel();
  const auto result = straighten_creases(mesh, measured(mesh), context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(largest_motion(mesh, before), 0.0);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
