#include <gtest/gtest.h>

#include <limits>
#include <turnscan/reconstruction/floating.hpp>

namespace turnscan {
namespace {

constexpr double kAnyWay = std::numeric_limits<double>::infinity();
using Holders = std::vector<std::size_t>;

/// Points every millimetre from `low` to `high` along x.
PlacedPiece bar(int low, int high, bool stands) {
  PlacedPiece out;
  for (int x = low; x <= high; ++x) out.points.emplace_back(0.001f * float(x), 0.0f, 0.0f);
  out.stands = stands;
  return out;
}

TEST(FindHolders, WhatFloatsBelongsToTheNearestThatStands) {
  EXPECT_EQ(find_holders({bar(0, 10, true), bar(30, 40, true), bar(14, 18, false)}, kAnyWay),
            (Holders{0, 1, 0}));
  EXPECT_EQ(find_holders({bar(0, 10, true), bar(30, 40, true), bar(24, 28, false)}, kAnyWay),
            (Holders{0, 1, 1}));
}

TEST(FindHolders, AChainHangsTogether) {
  // The last is nearest to what the second holds, which the first holds.
  EXPECT_EQ(
      find_holders({bar(0, 10, true), bar(60, 70, true), bar(12, 30, false), bar(32, 36, false)},
                   kAnyWay),
      (Holders{0, 1, 0, 0}));
}

TEST(FindHolders, NotAcrossMoreThanAShareOfItsSize) {
  const std::vector<PlacedPiece> pieces{bar(0, 10, true), bar(14, 18, false), bar(-40, -8, false)};
  // The nearer one is too small for its gap of 4 mm; the farther one, behind 8 mm, is not.
  EXPECT_EQ(find_holders(pieces, 0.5), (Holders{0, 1, 0}));
  EXPECT_EQ(find_holders(pieces, 1.0), (Holders{0, 0, 0}));
}

TEST(FindHolders, NothingThatStandsHoldsNothing) {
  EXPECT_EQ(find_holders({bar(0, 10, false), bar(12, 20, false)}, kAnyWay), (Holders{0, 1}));
  EXPECT_EQ(find_holders({}, kAnyWay), Holders());
}

}  // namespace
}  // namespace turnscan
