#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>

#include "tests/geometry/dense_grid.hpp"
#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

DenseGrid sampled(std::array<int, 3> size, double cell, const Vec3d& origin,
                  const std::function<double(const Vec3d&)>& f) {
  DenseGrid grid{origin, cell, size, {}};
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        grid.values.push_back(float(f(origin + cell * Vec3d(i, j, k))));
      }
    }
  }
  return grid;
}

DenseGrid ball(int n) {
  return sampled({n, n, n}, 2.4 / (n - 1), Vec3d::Constant(-1.2),
                 [](const Vec3d& p) { return p.norm() - 1.0; });
}

TEST(Isosurface, ABallIsASphere) {
  const auto mesh = isosurface(ball(61), {}, RunContext());
  ASSERT_TRUE(mesh) << mesh.error().text();
  const MeshReport report = check_mesh(*mesh);
  EXPECT_TRUE(report.watertight()) << report.text();
  EXPECT_EQ(report.euler, 2);
  EXPECT_NEAR(report.volume_m3, 4.0 / 3.0 * std::numbers::pi, 0.01);
  EXPECT_NEAR(report.area_m2, 4.0 * std::numbers::pi, 0.05);
  // 2 % of a space diagonal for the snap, the rest for the linear interpolation.
  for (const Vec3f& v : mesh->vertices) ASSERT_NEAR(v.norm(), 1.0f, 2e-3f);
}

TEST(Isosurface, IsWatertightWhateverTheValues) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::array<int, 3> size = {1 + int(seed % 19), 1 + int(seed % 7), 1 + int(seed % 23)};
    std::uint64_t i = 0;
    // A third of the values are exactly zero, some are tiny, some huge.
    const auto mesh = isosurface(
        sampled(size, 0.1, Vec3d(1, 2, 3),
                [&](const Vec3d&) {
                  const double value = random_value(seed, ++i);
                  return i % 3 == 0 ? 0.0 : value * (i % 5 == 0 ? 1e-30 : i % 7 == 0 ? 1e30 : 1.0);
                }),
        {}, RunContext());
    ASSERT_TRUE(mesh);
    if (mesh->empty()) continue;
    const MeshReport report = check_mesh(*mesh);
    ASSERT_TRUE(report.closed && report.manifold && report.oriented)
        << "seed " << seed << ": " << report.text();
    ASSERT_EQ(report.degenerate_triangles, 0u);
    ASSERT_GT(report.volume_m3, 0.0);
  }
}

TEST(Isosurface, CubesGiveTheSameBallWithAThirdOfTheTriangles) {
  const auto fine = isosurface(ball(61), {}, RunContext());
  const auto mesh = isosurface(ball(61), MarchingCells::kCubes, RunContext());
  ASSERT_TRUE(fine && mesh);
  const MeshReport report = check_mesh(*mesh);
  EXPECT_TRUE(report.watertight()) << report.text();
  EXPECT_EQ(report.euler, 2);
  EXPECT_NEAR(report.volume_m3, 4.0 / 3.0 * std::numbers::pi, 0.01);
  for (const Vec3f& v : mesh->vertices) ASSERT_NEAR(v.norm(), 1.0f, 2e-3f);
  EXPECT_LT(mesh->triangles.size(), 0.4 * double(fine->triangles.size()));
}

TEST(Isosurface, CubesAreWatertightWhateverTheValues) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::array<int, 3> size = {1 + int(seed % 19), 1 + int(seed % 7), 1 + int(seed % 23)};
    std::uint64_t i = 0;
    const auto mesh = isosurface(
        sampled(size, 0.1, Vec3d(1, 2, 3),
                [&](const Vec3d&) { return ++i % 3 == 0 ? 0.0 : random_value(seed, i); }),
        MarchingCells::kCubes, RunContext());
    ASSERT_TRUE(mesh);
    if (mesh->empty()) continue;
    const MeshReport report = check_mesh(*mesh);
    EXPECT_EQ(report.boundary_edges, 0) << seed;
    EXPECT_EQ(report.non_manifold_edges, 0) << seed;
    EXPECT_EQ(report.non_manifold_vertices, 0) << seed;
    EXPECT_GT(report.volume_m3, 0.0) << seed;
  }
}

TEST(Isosurface, ClosesAtTheBorderOfTheGridHalfACellOutside) {
  for (const int n : {1, 7, 8, 9, 17}) {
    const auto mesh =
        isosurface(sampled({n, n, n}, 1.0, Vec3d::Zero(), [](const Vec3d&) { return -1.0; }), {},
                   RunContext());
    ASSERT_TRUE(mesh);
    const MeshReport report = check_mesh(*mesh);
    EXPECT_TRUE(report.watertight()) << n << ": " << report.text();
    const Box box = bounds(mesh->vertices);
    EXPECT_EQ(box.min, Vec3d::Constant(-0.5)) << n;
    EXPECT_EQ(box.max, Vec3d::Constant(n - 0.5)) << n;
  }
}

TEST(Isosurface, NothingInsideGivesAnEmptyMesh) {
  const auto nothing = sampled({9, 9, 9}, 1.0, Vec3d::Zero(), [](const Vec3d&) { return 0.0; });
  EXPECT_TRUE(isosurface(nothing, {}, RunContext())->empty());
  EXPECT_TRUE(isosurface(BrickGrid(), {}, RunContext())->empty());
}

TEST(Isosurface, SparseAndDenseGridsAgree) {
  const DenseGrid dense = ball(37);
  auto sparse = BrickGrid::create(dense.origin_m, dense.cell_m, dense.size, 1.0f, 1 << 20);
  ASSERT_TRUE(sparse);
  const auto& n = sparse->bricks();
  const auto value = [&](int i, int j, int k) {
    return dense.values[std::size_t(i) + 37 * (std::size_t(j) + 37 * std::size_t(k))];
  };
  // Only bricks with both signs, or beside the other sign, get samples; the rest one value.
  for (std::size_t b = 0; b < sparse->brick_count(); ++b) {
    const auto at = sparse->brick_at(b);
    ASSERT_EQ(sparse->brick_index(at[0], at[1], at[2]), b);
    bool positive = false, negative = false;
    for (int c = 0; c < 1000; ++c) {
      const int i = at[0] * 8 - 1 + c % 10, j = at[1] * 8 - 1 + c / 10 % 10,
                k = at[2] * 8 - 1 + c / 100;
      if (std::min({i, j, k}) < 0 || std::max({i, j, k}) > 36) continue;
      (value(i, j, k) < 0.0f ? negative : positive) = true;
    }
    if (positive && negative) {
      ASSERT_TRUE(sparse->allocate({b}));
    } else {
      sparse->uniform(b) = negative ? -1.0f : 1.0f;
    }
  }
  std::size_t touched = 0;
  for (int k = 0; k < 37; ++k) {
    for (int j = 0; j < 37; ++j) {
      for (int i = 0; i < 37; ++i) {
        float* own = sparse->samples(sparse->brick_index(i / 8, j / 8, k / 8));
        touched += own != nullptr;
        if (own != nullptr) own[BrickGrid::within(i, j, k)] = value(i, j, k);
      }
    }
  }
  EXPECT_LT(touched, 37u * 37u * 37u) << "some bricks stay uniform";
  EXPECT_EQ(n[0], 5);
  const auto a = isosurface(dense, {}, RunContext());
  const auto b = isosurface(*sparse, {}, RunContext());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->vertices, b->vertices);
  EXPECT_EQ(a->triangles, b->triangles);
}

TEST(Isosurface, NoEdgeShrinksToNothing) {
  const auto mesh = isosurface(ball(41), {}, RunContext());
  ASSERT_TRUE(mesh);
  float shortest = 1e9f;
  for (const auto& t : mesh->triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3f edge = mesh->vertices[t[c]] - mesh->vertices[t[(c + 1) % 3]];
      shortest = std::min(shortest, edge.norm());
    }
  }
  EXPECT_GT(shortest, 0.01 * 0.06);
}

TEST(Isosurface, IsTheSameForOneAndTwoThreads) {
  set_thread_count(1);
  const auto one = isosurface(ball(70), {}, RunContext());
  set_thread_count(2);
  const auto two = isosurface(ball(70), {}, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->vertices, two->vertices);
  EXPECT_EQ(one->triangles, two->triangles);
}

TEST(Isosurface, FailsByNameOnWhatItCannotDo) {
  DenseGrid grid = ball(10);
  grid.values[555] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(isosurface(grid, {}, RunContext()).error().code, ErrorCode::kFormat);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(isosurface(ball(10), {}, context).error().code, ErrorCode::kCancelled);
}

TEST(BrickGrid, RefusesSizesItCannotHold) {
  const auto code = [](std::array<int, 3> size, double cell, std::size_t bytes) {
    return BrickGrid::create(Vec3d::Zero(), cell, size, 0.0f, bytes).error().code;
  };
  EXPECT_EQ(code({0, 1, 1}, 1.0, 1000), ErrorCode::kInvalidOption);
  EXPECT_EQ(code({1, 1, 1 << 21}, 1.0, 1000), ErrorCode::kInvalidOption);
  EXPECT_EQ(code({8, 8, 8}, 0.0, 1000), ErrorCode::kInvalidOption);
  EXPECT_EQ(code({1 << 20, 1 << 20, 1 << 20}, 1.0, std::size_t(1) << 32),
            ErrorCode::kResourceLimit);
  auto grid = BrickGrid::create(Vec3d::Zero(), 1.0, {80, 80, 80}, 0.0f, 50000);
  ASSERT_TRUE(grid);
  EXPECT_TRUE(grid->allocate({1, 2, 3}));
  std::vector<std::size_t> all(grid->brick_count());
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = b;
  EXPECT_EQ(grid->allocate(all).error().code, ErrorCode::kResourceLimit);
}

}  // namespace
}  // namespace turnscan
