#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/geometry/estimation/robust.hpp>

namespace turnscan::estimation {
namespace {

/// By differences, of a cost that grows with the residual's size.
template <class Cost>
double derivative(const Cost& cost, double at) {
  constexpr double kStep = 1e-6;
  return (cost(at + kStep) - cost(at - kStep)) / (2.0 * kStep);
}

TEST(Robust, HubersWeightIsTheDerivativeOfItsCostOverTwiceTheResidual) {
  for (const double size : {0.1, 0.5, 0.99, 1.01, 2.0, 7.0}) {
    const double slope = derivative([](double s) { return huber_cost(s, 1.0); }, size);
    EXPECT_NEAR(huber_weight(size, 1.0), slope / (2.0 * size), 1e-8) << size;
  }
}

TEST(Robust, HubersCostIsASquareUpToTheLimitAndContinuousThere) {
  EXPECT_EQ(huber_cost(0.3, 0.5), 0.3 * 0.3);
  EXPECT_NEAR(huber_cost(0.5 + 1e-12, 0.5), 0.25, 1e-11);
  EXPECT_EQ(huber_weight(0.5, 0.5), 1.0);
}

TEST(Robust, TukeysWeightFallsFromOneToNothingAtTheLimit) {
  EXPECT_EQ(tukey_weight(0.0), 1.0);
  EXPECT_EQ(tukey_weight(1.0), 0.0);
  EXPECT_EQ(tukey_weight(-3.0), 0.0);
  EXPECT_EQ(tukey_weight(std::nan("")), 0.0);
  // (1 - u^2)^2 is the derivative of (1 - (1 - u^2)^3) / 3 over twice u.
  const auto cost = [](double u) { return (1.0 - std::pow(1.0 - u * u, 3)) / 3.0; };
  for (const double u : {0.1, 0.4, 0.8})
    EXPECT_NEAR(tukey_weight(u), derivative(cost, u) / (2.0 * u), 1e-8);
}

TEST(Robust, TheMedianOfSizesIsTheStandardDeviationOfNormalErrors) {
  std::vector<double> sizes;
  for (std::uint64_t i = 0; i < 100000; ++i)
    sizes.push_back(std::abs(0.7 * standard_normal(hash_key(1, i))));
  std::vector<double> squares;
  for (const double size : sizes) squares.push_back(size * size / 0.49);
  EXPECT_NEAR(mad_sigma(sizes), 0.7, 0.01);
  EXPECT_NEAR(median(squares), kMedianOfSquare, 0.01);
}

TEST(Robust, WithoutErrorsTheScaleIsZero) {
  std::vector<float> none;
  EXPECT_EQ(mad_sigma(none), 0.0);
}

}  // namespace
}  // namespace turnscan::estimation
