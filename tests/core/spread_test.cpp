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

TEST(EvenlySpread, OfNothingOrNoneIsNothing) {
  EXPECT_TRUE(evenly_spread(std::vector<int>(), 5).empty());
  EXPECT_TRUE(evenly_spread(std::vector<int>{1, 2}, 0).empty());
}

}  // namespace
}  // namespace turnscan
