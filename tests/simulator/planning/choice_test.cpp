#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/planning/choice.hpp>

namespace turnscan::planning {
namespace {

/// Candidates that cover some of the points each, for every alternative of every group.
std::vector<ChoiceGroup> random_groups(std::uint64_t seed, std::size_t candidates,
                                       std::size_t points, std::size_t alternatives) {
  std::vector<ChoiceGroup> groups(2);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    groups[g].weight = 1 + g;
    for (std::size_t a = 0; a < alternatives; ++a) {
      WorthTable& table = groups[g].alternatives.emplace_back();
      table.points = points;
      for (std::size_t i = 0; i < candidates * points; ++i) {
        const double u = uniform01(hash_key(seed, g, a, i));
        table.worth.push_back(u < 0.3 ? std::uint16_t(1000.0 * u) : std::uint16_t(0));
      }
    }
  }
  return groups;
}

/// The most that any set of `most` candidates is worth.
std::uint64_t exhaustive(const std::vector<ChoiceGroup>& groups, std::size_t n, std::size_t most) {
  std::uint64_t best = 0;
  for (std::uint32_t mask = 0; mask < 1u << n; ++mask) {
    std::vector<std::uint32_t> set;
    for (std::uint32_t i = 0; i < n; ++i)
      if (mask >> i & 1) set.push_back(i);
    if (set.size() <= most) best = std::max(best, value_of(groups, set));
  }
  return best;
}

TEST(Choice, IsTheBestOfAllSetsWhereItIsProven) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::size_t alternatives : {1u, 3u}) {
      const auto groups = random_groups(seed, 9, 12, alternatives);
      const auto choice = choose(groups, {3, 100000}, {});
      ASSERT_TRUE(choice);
      EXPECT_EQ(choice->value, exhaustive(groups, 9, 3)) << seed;
      EXPECT_EQ(choice->bound, choice->value);
      EXPECT_EQ(choice->value, value_of(groups, choice->candidates));
    }
  }
}

TEST(Choice, StatesABoundThatHoldsWhereTheSearchIsCutShort) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto groups = random_groups(seed, 10, 14, 1);
    const auto choice = choose(groups, {4, 1}, {});
    ASSERT_TRUE(choice);
    const std::uint64_t best = exhaustive(groups, 10, 4);
    EXPECT_LE(best, choice->bound);
    EXPECT_GE(double(choice->value), 0.632 * double(best));  // 1 - 1/e
  }
}

TEST(Choice, NeverTakesACandidateThatAnotherDominates) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto groups = random_groups(seed, 6, 12, 2);
    // A seventh that is worth less than the third, wherever that is worth anything.
    for (ChoiceGroup& group : groups)
      for (WorthTable& table : group.alternatives)
        for (std::size_t i = 0; i < table.points; ++i)
          table.worth.push_back(table.row(2)[i] == 0 ? 0 : std::uint16_t(table.row(2)[i] - 1));
    const auto choice = choose(groups, {4, 1000}, {});
    ASSERT_TRUE(choice);
    EXPECT_EQ(std::count(choice->candidates.begin(), choice->candidates.end(), 6u), 0);
  }
}

TEST(Choice, LeavesOutWhatAddsNothing) {
  ChoiceGroup group;
  group.alternatives.push_back({2, {5, 5, 5, 0, 0, 5}});
  const auto choice = choose({group}, {3, 1000}, {});
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->candidates, std::vector<std::uint32_t>{0});
}

TEST(Choice, IsTheSameForEveryNumberOfThreads) {
  const auto groups = random_groups(5, 40, 60, 2);
  const auto many = choose(groups, {3, 50}, {});
  std::vector<std::uint32_t> one;
  run_on_this_thread([&] { one = choose(groups, {3, 50}, {})->candidates; });
  ASSERT_TRUE(many);
  EXPECT_EQ(many->candidates, one);
}

TEST(Choice, CanBeCancelled) {
  const RunContext context;
  context.cancel();
  const auto choice = choose(random_groups(1, 5, 5, 1), {2, 10}, context);
  ASSERT_FALSE(choice);
  EXPECT_EQ(choice.error().code, ErrorCode::kCancelled);
}

TEST(Choice, RefusesTablesThatDoNotFit) {
  ChoiceGroup group;
  group.alternatives.push_back({2, {1, 2, 3, 4}});
  group.alternatives.push_back({2, {1, 2}});
  EXPECT_THROW((void)choose({group}, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace turnscan::planning
