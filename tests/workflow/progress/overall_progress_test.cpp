#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <vector>

namespace turnscan {
namespace {

/// A run on a clock of its own, whose every state is kept.
struct TimedRun {
  OverallProgress overall;
  double now_s = 0.0;
  int number = 0;
  std::vector<double> fractions;
  std::vector<double> seconds_left;

  void phase(const std::string& name, double seconds, bool says_how_far = true) {
    ++number;
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; ++i) {
      overall.update({name, number, says_how_far ? double(i) / kSteps : 0.0}, now_s);
      if (const auto fraction = overall.fraction()) fractions.push_back(*fraction);
      if (const auto left = overall.seconds_left()) seconds_left.push_back(*left);
      if (i < kSteps) now_s += seconds / kSteps;
    }
  }
};

void expect_never_falls(const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) ASSERT_GE(values[i], values[i - 1]) << i;
}

void expect_counts_down(const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) ASSERT_LE(values[i], values[i - 1] + 1e-9) << i;
}

TEST(OverallProgress, FollowsThePlanFromNothingToTheEnd) {
  TimedRun run;
  run.overall.plan({{"read", 3.0}, {"fit", 1.0}});
  run.phase("read", 3.0);
  EXPECT_NEAR(run.fractions.back(), 0.75, 1e-9);
  run.phase("fit", 1.0);
  EXPECT_EQ(run.fractions.front(), 0.0);
  EXPECT_NEAR(run.fractions.back(), 0.995, 1e-9);
  expect_never_falls(run.fractions);
}

TEST(OverallProgress, TimeLeftCountsDownToNothingWhenThePlanIsRight) {
  TimedRun run;
  run.overall.plan({{"read", 30.0}, {"fit", 10.0}, {"finish", 20.0}});
  run.phase("read", 30.0);
  EXPECT_NEAR(run.seconds_left.back(), 30.0, 0.5);
  run.phase("fit", 10.0);
  run.phase("finish", 20.0);
  expect_counts_down(run.seconds_left);
  EXPECT_NEAR(run.seconds_left.back(), 0.0, 0.5);
}

TEST(OverallProgress, TimeLeftStandsStillRatherThanGrowsWhenALaterPhaseIsSlower) {
  TimedRun run;
  run.overall.plan({{"read", 10.0}, {"fit", 10.0}});
  run.phase("read", 10.0);
  run.phase("fit", 14.0);
  expect_counts_down(run.seconds_left);
  EXPECT_NEAR(run.seconds_left.back(), 0.0, 0.5);
}

TEST(OverallProgress, TimeLeftGrowsWhenAPhaseTakesManyTimesWhatItUsuallyDoes) {
  TimedRun run;
  run.overall.plan({{"read", 10.0}, {"fit", 10.0}});
  run.phase("read", 10.0);
  EXPECT_LT(run.seconds_left.back(), 11.0);
  const std::size_t before = run.seconds_left.size();
  run.phase("fit", 100.0);
  EXPECT_GT(
      *std::max_element(run.seconds_left.begin() + std::ptrdiff_t(before), run.seconds_left.end()),
      60.0);
  expect_never_falls(run.fractions);
}

TEST(OverallProgress, APhaseThatDoesNotComeLeavesItsShareToThoseBehindIt) {
  TimedRun run;
  run.overall.plan({{"find the motion", 8.0}, {"read", 1.0}, {"fit", 1.0}});
  run.phase("read", 1.0);
  EXPECT_NEAR(run.fractions.back(), 0.5, 1e-9);
  run.phase("fit", 1.0);
  EXPECT_NEAR(run.fractions.back(), 0.995, 1e-9);
  expect_never_falls(run.fractions);
}

TEST(OverallProgress, APhaseThatNobodyPlannedTakesLittle) {
  TimedRun run;
  run.overall.plan({{"read", 1.0}, {"fit", 1.0}});
  run.phase("read", 1.0);
  run.phase("surprise", 1.0);
  EXPECT_GT(run.fractions.back(), 0.5);
  EXPECT_LT(run.fractions.back(), 0.55);
  run.phase("fit", 1.0);
  expect_never_falls(run.fractions);
}

TEST(OverallProgress, APhaseThatComesAgainDoesNotSkipWhatLiesBetween) {
  TimedRun run;
  run.overall.plan({{"read", 1.0}, {"fit", 1.0}, {"read", 1.0}, {"fit", 1.0}});
  run.phase("read", 1.0);
  run.phase("read", 1.0);
  EXPECT_LT(run.fractions.back(), 0.5);
  run.phase("fit", 1.0);
  run.phase("read", 1.0);
  run.phase("fit", 1.0);
  expect_never_falls(run.fractions);
}

TEST(OverallProgress, AWaitHasNoPercentageAndCostsNoTimeOfThePlan) {
  TimedRun run;
  run.overall.plan({{"open", 1.0}, {"wait", 0.0}, {"record", 9.0}});
  run.phase("open", 1.0);
  run.phase("wait", 1000.0, false);
  EXPECT_FALSE(run.overall.fraction());
  EXPECT_FALSE(run.overall.seconds_left());
  run.phase("record", 9.0);
  EXPECT_TRUE(run.overall.fraction());
  expect_never_falls(run.fractions);
  EXPECT_LT(*std::max_element(run.seconds_left.begin(), run.seconds_left.end()), 20.0);
}

TEST(OverallProgress, APhaseThatCannotSayHowFarItIsGoesOnAtThePaceOfThoseBefore) {
  TimedRun run;
  run.overall.plan({{"read", 10.0}, {"align", 10.0}, {"sample", 10.0}});
  run.phase("read", 10.0);
  run.phase("align", 5.0, false);
  EXPECT_NEAR(run.fractions.back(), 0.5, 0.02);
  run.phase("sample", 10.0);
  expect_never_falls(run.fractions);
}

TEST(OverallProgress, WithoutAPlanThereIsNoPercentage) {
  TimedRun run;
  run.phase("look for devices", 3.0);
  EXPECT_TRUE(run.fractions.empty());
  EXPECT_TRUE(run.seconds_left.empty());
}

TEST(OverallProgress, GoesOnFromWhereItIsWhenThePlanBecomesKnown) {
  TimedRun run;
  run.overall.plan({{"read", 1.0}, {"fit", 1.0}});
  run.phase("read", 1.0);
  run.overall.plan({{"fit", 1.0}, {"fit", 1.0}});
  run.phase("fit", 1.0);
  EXPECT_NEAR(run.fractions.back(), 0.75, 1e-9);
  run.phase("fit", 1.0);
  expect_never_falls(run.fractions);
}

}  // namespace
}  // namespace turnscan
