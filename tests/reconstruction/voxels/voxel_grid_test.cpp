#include <gtest/gtest.h>

#include <map>
#include <tests/support/synthetic_cloud.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::points {
namespace {

std::vector<Vec3f> random_points(std::size_t n, float spread) {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < n; ++i)
    points.emplace_back(spread * float(standard_normal(hash_key(5, i, 0))),
                        spread * float(standard_normal(hash_key(5, i, 1))),
                        spread * float(standard_normal(hash_key(5, i, 2))));
  return points;
}

std::array<int, 3> slow_index(const Vec3f& p, double size) {
  return {int(std::floor(p.z() * (1.0 / size))), int(std::floor(p.y() * (1.0 / size))),
          int(std::floor(p.x() * (1.0 / size)))};
}

TEST(VoxelGrid, CountsLikeAMapFromVoxelsToPoints) {
  const auto points = random_points(20000, 0.05f);
  std::map<std::array<int, 3>, std::vector<std::uint32_t>> oracle;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    oracle[slow_index(points[i], 0.007)].push_back(i);
  const auto grid = voxels::VoxelGrid::build(points, 0.007, RunContext());
  ASSERT_TRUE(grid);
  ASSERT_EQ(grid->voxels().size(), oracle.size());
  auto expected = oracle.begin();
  for (const auto& voxel : grid->voxels()) {
    EXPECT_EQ((std::array<int, 3>{voxel.index.z(), voxel.index.y(), voxel.index.x()}),
              expected->first);
    const std::vector<std::uint32_t> members(grid->order().begin() + voxel.begin,
                                             grid->order().begin() + voxel.end);
    EXPECT_EQ(members, expected->second);
    ++expected;
  }
}

TEST(VoxelGrid, LiesOnTheAxesAndNotOnTheBoundsOfTheCloud) {
  const auto a = voxels::VoxelGrid::build({Vec3f(0.0101f, 0, 0)}, 0.002, RunContext());
  const auto b = voxels::VoxelGrid::build({Vec3f(0.0101f, 0, 0), Vec3f(-0.5f, 0.3f, 0.2f)}, 0.002,
                                          RunContext());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->voxels()[0].index, voxels::VoxelIndex(5, 0, 0));
  EXPECT_GE(b->find(voxels::VoxelIndex(5, 0, 0)), 0);
}

TEST(VoxelGrid, FindsEachOccupiedVoxelAndNoOther) {
  const auto points = random_points(500, 0.01f);
  const auto grid = voxels::VoxelGrid::build(points, 0.003, RunContext());
  ASSERT_TRUE(grid);
  std::size_t found = 0;
  for (int z = -30; z < 30; ++z)
    for (int y = -30; y < 30; ++y)
      for (int x = -30; x < 30; ++x) {
        const auto i = grid->find(voxels::VoxelIndex(x, y, z));
        if (i < 0) continue;
        ++found;
        EXPECT_EQ(grid->voxels()[std::size_t(i)].index, voxels::VoxelIndex(x, y, z));
      }
  EXPECT_EQ(found, grid->voxels().size());
}

TEST(VoxelGrid, ABoxVisitsWhatLiesInItAndNothingElse) {
  const auto points = random_points(3000, 0.01f);
  const auto grid = voxels::VoxelGrid::build(points, 0.002, RunContext());
  ASSERT_TRUE(grid);
  const voxels::VoxelIndex low(-3, -2, -4), high(2, 5, 1);
  std::vector<std::uint32_t> seen;
  grid->for_each_in_box(low, high, [&](std::uint32_t i) { seen.push_back(i); });
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < grid->voxels().size(); ++i) {
    const voxels::VoxelIndex& v = grid->voxels()[i].index;
    if ((v.array() >= low.array()).all() && (v.array() <= high.array()).all())
      expected.push_back(i);
  }
  EXPECT_EQ(seen, expected);
}

TEST(VoxelGrid, FilterDropsVoxelsAndKeepsTheRestFindable) {
  const auto points = random_points(3000, 0.01f);
  auto grid = voxels::VoxelGrid::build(points, 0.002, RunContext());
  ASSERT_TRUE(grid);
  const auto keep = voxels::count_filter(*grid, 3);
  std::size_t expected = 0;
  for (const auto& voxel : grid->voxels()) expected += voxel.count() >= 3 ? 1 : 0;
  grid->filter(keep);
  EXPECT_EQ(grid->voxels().size(), expected);
  for (const auto& voxel : grid->voxels()) {
    EXPECT_GE(voxel.count(), 3u);
    EXPECT_GE(grid->find(voxel.index), 0);
  }
}

TEST(VoxelGrid, IsTheSameForOneAndTwoThreads) {
  const auto points = random_points(200000, 0.05f);
  set_thread_count(1);
  const auto one = voxels::VoxelGrid::build(points, 0.002, RunContext());
  set_thread_count(2);
  const auto two = voxels::VoxelGrid::build(points, 0.002, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->order(), two->order());
}

TEST(VoxelGrid, RefusesAVoxelFarTooSmallForTheCloud) {
  const auto grid =
      voxels::VoxelGrid::build({Vec3f(0, 0, 0), Vec3f(100, 100, 100)}, 1e-5, RunContext());
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().code, ErrorCode::kInvalidOption);
}

TEST(VoxelGrid, RefusesAnEmptyCloud) {
  EXPECT_EQ(voxels::VoxelGrid::build({}, 0.001, RunContext()).error().code,
            ErrorCode::kTooFewPoints);
}

TEST(VoxelGrid, GivesNothingOnceCancelled) {
  const RunContext context;
  context.cancel();
  EXPECT_EQ(voxels::VoxelGrid::build({Vec3f::Zero()}, 0.001, context).error().code,
            ErrorCode::kCancelled);
}

TEST(ChooseMinPoints, KeepsTheSurfaceAndDropsScatter) {
  voxels::MergedCloud merged = testing::noisy_plane(200000, 0.05, 0.0);
  for (std::uint64_t i = 0; i < 2000; ++i)
    merged.cloud.points.emplace_back(float(0.1 * uniform01(hash_key(9, i, 0)) - 0.05),
                                     float(0.002 + 0.1 * uniform01(hash_key(9, i, 1))),
                                     float(0.1 * uniform01(hash_key(9, i, 2)) - 0.05));
  auto grid = voxels::VoxelGrid::build(merged.cloud.points, 0.001, RunContext());
  ASSERT_TRUE(grid);
  const voxels::ThresholdChoice choice = choose_min_points(*grid);
  EXPECT_GT(choice.min_points, 1);
  grid->filter(voxels::count_filter(*grid, choice.min_points));
  std::size_t on_plane = 0, off_plane = 0;
  for (const auto& voxel : grid->voxels())
    ++(std::abs(voxel.index.y()) <= 1 ? on_plane : off_plane);
  EXPECT_GE(on_plane, 9900u);
  EXPECT_LE(off_plane, 20u);
}

TEST(ChooseMinPoints, IsOneForASparseCloud) {
  const auto grid = voxels::VoxelGrid::build(random_points(100, 1.0f), 0.001, RunContext());
  ASSERT_TRUE(grid);
  EXPECT_EQ(choose_min_points(*grid).min_points, 1);
}

TEST(VoxelOptions, RefuseValuesOutsideTheirRange) {
  VoxelOptions options;
  EXPECT_FALSE(describe(options).set("voxel-size", "0mm"));
  EXPECT_FALSE(describe(options).set("voxel-size", "5"));
  EXPECT_FALSE(describe(options).set("voxel-grid", "1"));
  EXPECT_FALSE(describe(options).set("voxel-min-points", "0"));
  EXPECT_TRUE(describe(options).set("voxel-size", "1.5mm"));
  EXPECT_DOUBLE_EQ(*options.size_m, 0.0015);
  options.size_m = std::nan("");
  EXPECT_FALSE(describe(options).check());
}

}  // namespace
}  // namespace turnscan::points
