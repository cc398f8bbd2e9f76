#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/workflow/verdict/error_shares.hpp>

namespace turnscan {

namespace {

constexpr double kMax_m = 1.0;

/// Probability that an error is less than `ratio` times the expected one (Abramowitz and Stegun
/// 26.7.3, five degrees of freedom).
double probability_within(double ratio) {
  constexpr double kScale = 1.1105;
  const double angle = std::atan(kScale * ratio / std::sqrt(5.0)), c = std::cos(angle);
  return 2.0 / std::numbers::pi * (angle + std::sin(angle) * (c + 2.0 / 3.0 * c * c * c));
}

}  // namespace

void ErrorShares::add(double expected_error_m, double area_m2) {
  pieces_.push_back({std::max(expected_error_m, 1e-9), area_m2});
}

double ErrorShares::within(double distance_m) const {
  double within = 0.0, area = 0.0;
  for (const Piece& piece : pieces_) {
    within += piece.area_m2 * probability_within(distance_m / piece.sigma_m);
    area += piece.area_m2;
  }
  return area > 0.0 ? within / area : 0.0;
}

std::optional<double> ErrorShares::error_of(double share) const {
  double low = 0.0, high = kMax_m;
  if (within(high) < share) return std::nullopt;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (within(middle) < share ? low : high) = middle;
  }
  return high;
}

}  // namespace turnscan
