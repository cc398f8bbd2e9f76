#pragma once
// How far a reconstruction is expected to lie from the surface at a spot.

#include <turnscan/simulator/planning/turn_view.hpp>

namespace turnscan::planning {

/// Expected distance |mesh - truth| at a spot that was seen:
///
///   e^2 = (a sigma / sqrt(n))^2 + (b sigma)^2 + (c d)^2 + (f relief(d))^2
///
/// sigma: of a sample along its ray, the mean of all frames by information; n: frames that see it,
/// each weighted by the cosine of its incidence; d: distance of samples on the object; relief(d):
/// how far the surface lies from its mean within d, which a grid of samples cannot show. The form is
/// that of reconstruction/quality (noise averaged, a floor that frames do not average out, blur); the
/// factors are fitted to the median errors of simulated scans and their reconstructions
/// (bench/plan_bench fit; docs/plan.md), and held against others.
struct ErrorModel {
  double noise = 0.5, floor = 0.037, spacing = 0.03, relief = 0.3;

  /// Metres. Precondition: sight.seen().
  double at(const Spot& spot, const SpotSight& sight) const;
};

/// The parts of the formula with factor 1: noise, floor, spacing, relief.
std::array<double, 4> error_parts(const Spot& spot, const SpotSight& sight);

}  // namespace turnscan::planning
