#pragma once
// From a rough circle to the platter's rim with its covariance.

#include <turnscan/turntable/detection/rim_likelihood.hpp>

namespace turnscan::detection {

struct RimEstimate {
  RimModel model;
  EdgeResponse edge;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of RimGradient's unknowns
  double explained = 0.0;  ///< mean probability of what the edge's pixels see
  double agreement = 0.0;  ///< share of the pixels beside the edge that are on their side of it
  double rim_share = 0.0;  ///< of the bearings, those with the platter inside and not outside
  std::size_t edge_pixels = 0, wall_pixels = 0;
  double log_likelihood = 0.0;
};

/// nullopt when it runs away from the start, when too little of the rim is there, or once the
/// context is cancelled.
std::optional<RimEstimate> estimate_rim(const PlaneView& view, const RimModel& start,
                                        const NoiseCorrelation& noise,
                                        std::optional<double> radius_m, const RunContext& context);

}  // namespace turnscan::detection
