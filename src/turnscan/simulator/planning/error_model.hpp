#pragma once
// Expected error of a reconstruction at a spot of the surface.

#include <turnscan/simulator/planning/turn_view.hpp>

namespace turnscan::planning {

/// Expected distance |mesh - truth| at a spot that was seen:
///
///   e^2 = (0.193 s)^2 + (0.018 sigma)^2 + (0.041 d)^2 + (0.46 r(d))^2 + (0.294 r6 s / 0.4 mm)^2
///   s = sigma / sqrt(n)
///
/// sigma: of a sample along its ray, the mean of all frames by information; n: frames that see it,
/// each weighted by the cosine of its incidence; d: distance of samples on the object; r(d):
/// deviation of the surface from its mean within d, which a grid of samples cannot resolve; r6:
/// within 6 mm, which is large on thin parts, where smoothing against noise loses more of the
/// surface. The form is that of reconstruction/quality (averaged noise, a floor that frames do not
/// average out, blur). The factors are fitted to the median errors of 82 simulated scans and their
/// reconstructions (bench/plan_bench model and choices; docs/reference/plan.md tells how well they
/// generalise, also to other objects).
struct ErrorModel {
  static constexpr std::size_t kParts = 5;
  std::array<double, kParts> factors{0.193, 0.018, 0.041, 0.46, 0.294};

  /// Metres. Precondition: sight.chance() > 0.
  double at(const Spot& spot, const SpotSight& sight) const;
};

/// The terms of the formula without their factors, in its order; metres.
std::array<double, ErrorModel::kParts> error_parts(const Spot& spot, const SpotSight& sight);

}  // namespace turnscan::planning
