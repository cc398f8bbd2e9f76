#include <gtest/gtest.h>

#include <turnscan/reconstruction/points/components.hpp>

namespace turnscan::points {
namespace {

/// n points in each of the given unit voxels.
voxels::VoxelGrid grid_of(const std::vector<std::pair<voxels::VoxelIndex, int>>& voxels) {
  static std::vector<std::vector<Vec3f>> alive;  // a grid refers to its points
  std::vector<Vec3f> points;
  for (const auto& [index, n] : voxels)
    points.insert(points.end(), std::size_t(n), index.cast<float>() + Vec3f::Constant(0.5f));
  alive.push_back(points);
  return *voxels::VoxelGrid::build(alive.back(), 1.0, RunContext());
}

std::int32_t label_at(const voxels::VoxelGrid& grid, const Components& c,
                      const voxels::VoxelIndex& index) {
  return c.label.at(std::size_t(grid.find(index)));
}

TEST(Components, TouchAcrossFacesEdgesAndCorners) {
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0 && dz == 0) continue;
        const voxels::VoxelGrid grid = grid_of({{{0, 0, 0}, 1}, {{dx, dy, dz}, 1}});
        EXPECT_EQ(find_components(grid, {}, 1)->voxel_count.size(), 1u);
      }
}

TEST(Components, AGapOfOneVoxelPartsThemUnlessTheReachBridgesIt) {
  const voxels::VoxelGrid grid = grid_of({{{0, 0, 0}, 1}, {{2, 0, 0}, 1}});
  EXPECT_EQ(find_components(grid, {}, 1)->voxel_count.size(), 2u);
  EXPECT_EQ(find_components(grid, {}, 4)->voxel_count.size(), 1u);
}

TEST(Components, TheOneWithTheMostPointsComesFirst) {
  const voxels::VoxelGrid grid = grid_of({{{0, 0, 0}, 5}, {{4, 0, 0}, 9}, {{8, 0, 0}, 7}});
  const auto c = find_components(grid, {}, 1);
  ASSERT_TRUE(c);
  EXPECT_EQ(label_at(grid, *c, {4, 0, 0}), 0);
  EXPECT_EQ(label_at(grid, *c, {8, 0, 0}), 1);
  EXPECT_EQ(label_at(grid, *c, {0, 0, 0}), 2);
}

TEST(Components, CrumbsGo) {
  ComponentOptions options;
  options.min_share = 0.1;
  const voxels::VoxelGrid grid = grid_of({{{0, 0, 0}, 100}, {{4, 0, 0}, 9}, {{8, 0, 0}, 11}});
  const auto c = find_components(grid, options, 1);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->crumbs, 1u);
  EXPECT_EQ(c->voxel_count.size(), 2u);
  EXPECT_EQ(label_at(grid, *c, {4, 0, 0}), -1);
}

TEST(Components, KeepLargestKeepsOneAndANumberKeepsThatMany) {
  const voxels::VoxelGrid grid = grid_of({{{0, 0, 0}, 5}, {{4, 0, 0}, 9}, {{8, 0, 0}, 7}});
  ComponentOptions options;
  options.keep = "largest";
  EXPECT_EQ(find_components(grid, options, 1)->voxel_count.size(), 1u);
  options.keep = "2";
  const auto two = find_components(grid, options, 1);
  EXPECT_EQ(two->voxel_count.size(), 2u);
  EXPECT_EQ(two->not_kept, 1u);
}

TEST(Components, FollowAWindingPathAsOne) {
  std::vector<std::pair<voxels::VoxelIndex, int>> path;
  for (int i = 0; i < 200; ++i)
    path.push_back({{int(10 * std::sin(i * 0.1)), i / 4, int(10 * std::cos(i * 0.1))}, 1});
  EXPECT_EQ(find_components(grid_of(path), {}, 1)->voxel_count.size(), 1u);
}

/// A column of voxels from low to high, one point each.
void add_column(std::vector<std::pair<voxels::VoxelIndex, int>>& voxels, int x, int low, int high) {
  for (int y = low; y <= high; ++y) voxels.push_back({{x, y, 0}, 1});
}

TEST(Components, WhatFloatsBelongsToTheNearestThatStands) {
  std::vector<std::pair<voxels::VoxelIndex, int>> voxels;
  add_column(voxels, 0, 0, 30);   // stands
  add_column(voxels, 40, 0, 29);  // stands
  add_column(voxels, 0, 36, 55);  // floats above the first,
  add_column(voxels, 0, 61, 79);  // and this above that
  const voxels::VoxelGrid grid = grid_of(voxels);
  EXPECT_EQ(find_components(grid, {}, 1)->voxel_count.size(), 4u);
  const auto c = find_components(grid, {}, 1, 2.0);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->joined, 2u);
  ASSERT_EQ(c->voxel_count.size(), 2u);
  EXPECT_EQ(c->voxel_count[0], 31u + 20u + 19u);
  EXPECT_EQ(label_at(grid, *c, {0, 79, 0}), label_at(grid, *c, {0, 0, 0}));
  EXPECT_NE(label_at(grid, *c, {40, 0, 0}), label_at(grid, *c, {0, 0, 0}));
}

TEST(Components, NothingIsJoinedAcrossMoreThanHalfItsSizeNorWithoutAnythingThatStands) {
  std::vector<std::pair<voxels::VoxelIndex, int>> voxels;
  add_column(voxels, 0, 0, 20);
  add_column(voxels, 0, 32, 50);  // 12 voxels above
  EXPECT_EQ(find_components(grid_of(voxels), {}, 1, 2.0)->joined, 0u);
  EXPECT_EQ(find_components(grid_of(voxels), {}, 1, -5.0)->voxel_count.size(), 2u);
}

TEST(Components, CrumbsThatFloatAreStillCrumbs) {
  std::vector<std::pair<voxels::VoxelIndex, int>> voxels;
  add_column(voxels, 0, 0, 200);
  add_column(voxels, 0, 202, 203);
  const auto c = find_components(grid_of(voxels), {}, 1, 2.0);
  EXPECT_EQ(c->joined, 0u);
  EXPECT_EQ(c->crumbs, 1u);
}

TEST(ComponentOptions, RefuseWhatIsNeitherAWordNorANumber) {
  ComponentOptions options;
  for (const char* wrong : {"some", "0", "-1", "1.5", "", "nan"}) {
    options.keep = wrong;
    EXPECT_FALSE(objects_to_keep(options)) << wrong;
  }
  options.keep = "3";
  EXPECT_EQ(*objects_to_keep(options), 3);
  options.min_share = std::nan("");
  EXPECT_FALSE(describe(options).check());
}

}  // namespace
}  // namespace turnscan::points
