#pragma once
// Robust statistics: the scale of errors from their median, and weights that suppress outliers.

#include <cmath>
#include <turnscan/core/median.hpp>
#include <vector>

namespace turnscan::estimation {

/// Ratio of the standard deviation of normally distributed errors to their median absolute value.
inline constexpr double kMadToSigma = 1.4826;
/// The median of the square of a standard normal variable.
inline constexpr double kMedianOfSquare = 0.455;
/// Huber's limit, in standard deviations, at which an estimate is 95 % efficient for normal errors.
inline constexpr double kHuber95 = 1.345;

/// The standard deviation of errors from their absolute values, 0 without any. Reorders them.
template <class T>
double mad_sigma(std::vector<T>& sizes) {
  return kMadToSigma * median(sizes);
}

/// Weight of a residual by its absolute value: 1 up to the limit, then falling (Huber 1964).
constexpr double huber_weight(double size, double limit) {
  return size > limit ? limit / size : 1.0;
}

/// Contribution of the residual to the sum that these weights minimise: its square up to the limit,
/// then linear.
constexpr double huber_cost(double size, double limit) {
  return size > limit ? limit * (2.0 * size - limit) : size * size;
}

/// Tukey's biweight of a residual over the limit: it falls from 1 to 0 at the limit.
inline double tukey_weight(double residual_over_limit) {
  if (!(std::abs(residual_over_limit) < 1.0)) return 0.0;
  const double keep = 1.0 - residual_over_limit * residual_over_limit;
  return keep * keep;
}

}  // namespace turnscan::estimation
