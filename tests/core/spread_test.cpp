#include <gtest/gtest.h>

#include <numeric>
#include <turnscan/core/spread.hpp>

namespace turnscan {
namespace {

TEST(EvenlySpread, TakesAsManyAsAreWantedInOrderFromTheFirstOn) {
  for (const std::size_t size : {1u, 2u, 7u, 100u}) {
    std::vector<int> list(size);
    std::iota(list.begin(), list.end(), 0);
    for (const std::size_t most : {1u, 2u, 3u, 7u, 99u}) {
      const std::vector<int> some = evenly_spread(list, most);
      ASSERT_EQ(some.size(), std::min(size, most));
      EXPECT_EQ(some.front(), 0);
      for (std::size_t k = 1; k < some.size(); ++k) {
        const auto step = std::size_t(some[k] - some[k - 1]);
        EXPECT_GE(step, size / some.size());
        EXPECT_LE(step, size / some.size() + 1);
      }
    }
  }
}

TEST(EvenlySpread, ToTheLastTakesBothEnds) {
  for (const std::size_t size : {0u, 1u, 2u, 7u, 100u}) {
    std::vector<std::size_t> list(size);
    std::iota(list.begin(), list.end(), 0u);
    for (const std::size_t most : {2u, 3u, 7u, 99u}) {
      const auto some = evenly_spread_to_last(list, most);
      ASSERT_EQ(some.size(), std::min(size, most));
      if (size == 0) continue;
      EXPECT_EQ(some.front(), 0u);
      EXPECT_EQ(some.back(), size - 1);
      for (std::size_t k = 1; k < some.size(); ++k) {
        EXPECT_GE(some[k] - some[k - 1], (size - 1) / (some.size() - 1));
        EXPECT_LE(some[k] - some[k - 1], (size - 1) / (some.size() - 1) + 1);
      }
    }
  }
}

TEST(EvenlySpread, OfNothingOrNoneIsNothing) {
  EXPECT_TRUE(evenly_spread(std::vector<int>(), 5).empty());
  EXPECT_TRUE(evenly_spread(std::vector<int>{1, 2}, 0).empty());
}

}  // namespace
}  // namespace turnscan
