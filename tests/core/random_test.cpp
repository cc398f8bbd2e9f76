#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <turnscan/core/random.hpp>
#include <vector>

namespace turnscan {
namespace {

constexpr std::uint64_t kCount = 200'000;

TEST(Random, Mix64IsTheFinaliserOfSplitMix64) {
  // First outputs of SplitMix64 seeded with 0 (its state grows by the same constant each step).
  EXPECT_EQ(mix64(0), 0xe220a8397b1dcdafULL);
  EXPECT_EQ(mix64(0x9e3779b97f4a7c15ULL), 0x6e789e6aa1b965f4ULL);
}

TEST(Random, UniformIsNeverZeroOrOne) {
  EXPECT_GT(uniform01(0), 0.0);
  EXPECT_LT(uniform01(std::numeric_limits<std::uint64_t>::max()), 1.0);
}

TEST(Random, UniformFillsItsBinsEvenly) {
  std::vector<int> bins(20, 0);
  for (std::uint64_t i = 0; i < kCount; ++i)
    ++bins[static_cast<std::size_t>(uniform01(hash_key(1, i)) * 20.0)];
  double chi2 = 0.0;
  const double expected = double(kCount) / 20.0;
  for (const int n : bins) chi2 += (n - expected) * (n - expected) / expected;
  EXPECT_LT(chi2, 43.8);  // 99.9 % quantile, 19 degrees of freedom
}

TEST(Random, NormalHasTheMomentsOfAStandardNormal) {
  double s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double z = standard_normal(hash_key(2, i));
    s1 += z;
    s2 += z * z;
    s3 += z * z * z;
    s4 += z * z * z * z;
  }
  const double n = double(kCount), root = std::sqrt(n);
  // Four standard errors of each moment.
  EXPECT_NEAR(s1 / n, 0.0, 4.0 * std::sqrt(1.0) / root);
  EXPECT_NEAR(s2 / n, 1.0, 4.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(s3 / n, 0.0, 4.0 * std::sqrt(15.0) / root);
  EXPECT_NEAR(s4 / n, 3.0, 4.0 * std::sqrt(96.0) / root);
}

TEST(Random, NormalHasTheTailsOfAStandardNormal) {
  int beyond_two = 0, beyond_three = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double z = std::abs(standard_normal(hash_key(3, i)));
    beyond_two += z > 2.0;
    beyond_three += z > 3.0;
  }
  EXPECT_NEAR(beyond_two / double(kCount), 0.0455, 0.002);
  EXPECT_NEAR(beyond_three / double(kCount), 0.0027, 0.0005);
}

double correlation(std::uint64_t (*first)(std::uint64_t), std::uint64_t (*second)(std::uint64_t)) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i)
    sum += standard_normal(first(i)) * standard_normal(second(i));
  return sum / double(kCount);
}

TEST(Random, NeighbouringPixelsFramesAndSeedsAreUncorrelated) {
  const auto key = [](std::uint64_t i) { return hash_key(7, 1, 2, i); };
  EXPECT_NEAR(correlation(key, [](std::uint64_t i) { return hash_key(7, 1, 2, i + 1); }), 0, 0.01);
  EXPECT_NEAR(correlation(key, [](std::uint64_t i) { return hash_key(7, 1, 3, i); }), 0, 0.01);
  EXPECT_NEAR(correlation(key, [](std::uint64_t i) { return hash_key(7, 2, 2, i); }), 0, 0.01);
  EXPECT_NEAR(correlation(key, [](std::uint64_t i) { return hash_key(8, 1, 2, i); }), 0, 0.01);
}

TEST(Random, KeysOfDifferentCountersDiffer) {
  std::set<std::uint64_t> keys;
  for (std::uint64_t a = 0; a < 20; ++a)
    for (std::uint64_t b = 0; b < 20; ++b)
      for (std::uint64_t c = 0; c < 20; ++c) keys.insert(hash_key(0, a, b, c));
  EXPECT_EQ(keys.size(), 8000u);
}

}  // namespace
}  // namespace turnscan
