#include <algorithm>
#include <cmath>
#include <turnscan/simulator/planning/error_model.hpp>

namespace turnscan::planning {

namespace {

constexpr double kUsualNoise_m = 0.0004;  // averaged over frames

/// Below the known radii it falls with the square of the radius, like that of a curved surface;
/// beyond them the last value is used.
double relief_within(const Spot& spot, double radius_m) {
  const auto& radii = kReliefRadii_m;
  if (radius_m <= radii[0]) return double(spot.relief_m[0]) * std::pow(radius_m / radii[0], 2.0);
  for (std::size_t i = 1; i < radii.size(); ++i) {
    if (radius_m > radii[i]) continue;
    const double part = (radius_m - radii[i - 1]) / (radii[i] - radii[i - 1]);
    return (1.0 - part) * double(spot.relief_m[i - 1]) + part * double(spot.relief_m[i]);
  }
  return double(spot.relief_m.back());
}

}  // namespace

std::array<double, ErrorModel::kParts> error_parts(const Spot& spot, const SpotSight& sight) {
  const double n = std::max(double(sight.cosines), 1e-3);
  const double sigma = std::sqrt(n / std::max(double(sight.weights), 1e-9));
  const double spacing = std::sqrt(double(sight.steps_m2) / n);
  const double noise = sigma / std::sqrt(std::max(n, 1.0));
  return {noise, sigma, spacing, relief_within(spot, spacing),
          double(spot.relief_m.back()) * noise / kUsualNoise_m};
}

double ErrorModel::at(const Spot& spot, const SpotSight& sight) const {
  const auto parts = error_parts(spot, sight);
  double squares = 0.0;
  for (std::size_t k = 0; k < parts.size(); ++k) squares += std::pow(factors[k] * parts[k], 2.0);
  return std::sqrt(squares);
}

}  // namespace turnscan::planning
