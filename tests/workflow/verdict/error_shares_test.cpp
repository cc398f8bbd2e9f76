#include <turnscan/workflow/verdict/error_shares.hpp>

#include <gtest/gtest.h>

namespace turnscan {
namespace {

TEST(ErrorShares, HaveTwoThirdsWithinTheExpectedErrorAndHeavierTailsThanNormal) {
  ErrorShares shares;
  shares.add(0.001, 2.0);
  EXPECT_NEAR(shares.within(0.001), 0.683, 0.001);
  EXPECT_NEAR(shares.within(0.002315), 0.95, 0.001);  // normal: 1.96 times
  EXPECT_NEAR(shares.within(1.0), 1.0, 1e-6);
  EXPECT_EQ(shares.within(0.0), 0.0);
}

TEST(ErrorShares, WeighPiecesByTheirArea) {
  ErrorShares shares;
  shares.add(0.0, 3.0);
  shares.add(1e6, 1.0);
  EXPECT_NEAR(shares.within(0.001), 0.75, 1e-6);
}

TEST(ErrorShares, InvertTheirShare) {
  ErrorShares shares;
  shares.add(0.0003, 1.0);
  shares.add(0.0010, 2.0);
  for (const double share : {0.2, 0.5, 0.95})
    EXPECT_NEAR(shares.within(shares.error_of(share).value_or(0.0)), share, 1e-4);
}

TEST(ErrorShares, OfNoSurfaceAreNone) {
  EXPECT_EQ(ErrorShares().within(0.001), 0.0);
  EXPECT_FALSE(ErrorShares().error_of(0.5));
}

TEST(ErrorShares, DoNotKnowAnErrorOfAMetreOrMore) {
  ErrorShares shares;
  shares.add(0.001, 2.0);
  shares.add(1e6, 1.0);
  EXPECT_TRUE(shares.error_of(0.5));
  EXPECT_FALSE(shares.error_of(0.95));
}

}  // namespace
}  // namespace turnscan
