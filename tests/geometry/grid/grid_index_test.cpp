#include <gtest/gtest.h>

#include <set>
#include <turnscan/geometry/grid/grid_index.hpp>

namespace turnscan {
namespace {

TEST(GridIndex, NumbersEachCellOnceTheFirstCoordinateFastest) {
  const GridIndex grid({3, 4, 5});
  ASSERT_EQ(grid.count(), 60u);
  std::size_t expected = 0;
  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i, ++expected) {
        EXPECT_EQ(grid.at({i, j, k}), expected);
        EXPECT_EQ(grid.coords(expected), (GridCoords{i, j, k}));
        EXPECT_TRUE(grid.contains({i, j, k}));
      }
    }
  }
}

TEST(GridIndex, ContainsNothingBeyondIt) {
  const GridIndex grid({3, 4, 5});
  for (const GridCoords& c :
       {GridCoords{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {3, 0, 0}, {0, 4, 0}, {0, 0, 5}})
    EXPECT_FALSE(grid.contains(c));
  EXPECT_EQ(GridIndex().count(), 0u);
  EXPECT_FALSE(GridIndex().contains({0, 0, 0}));
}

TEST(SampleInBrick, GivesEachSampleOfABrickAPlaceOfItsOwn) {
  std::set<std::size_t> places;
  for (int k = 8; k < 16; ++k) {
    for (int j = -8; j < 0; ++j) {
      for (int i = 0; i < 8; ++i) places.insert(sample_in_brick(i, j, k));
    }
  }
  EXPECT_EQ(places.size(), kBrickSamples);
  EXPECT_EQ(*places.rbegin(), kBrickSamples - 1);
  EXPECT_EQ(sample_in_brick(9, 2, 3), 1u + 2u * 8u + 3u * kBrickLayer);
}

}  // namespace
}  // namespace turnscan
