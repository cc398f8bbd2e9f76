#pragma once
// Estimates the platter's rim and its covariance from an approximate circle.

#include <turnscan/turntable/detection/rim_likelihood.hpp>

namespace turnscan::detection {

struct RimEstimate {
  RimModel model;
  EdgeResponse edge;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of RimGradient's unknowns
  double explained = 0.0;  ///< mean probability of the labels of the edge's pixels
  double agreement = 0.0;  ///< share of the pixels beside the edge that are on their side of it
  double rim_share = 0.0;  ///< share of the bearings with the platter inside and not outside
  std::size_t edge_pixels = 0, wall_pixels = 0;
  double log_likelihood = 0.0;
};

/// nullopt if the fit diverges from the start, if too little of the rim is visible, or once the
/// context is cancelled.
std::optional<RimEstimate> estimate_rim(const PlaneView& view, const RimModel& start,
                                        const NoiseCorrelation& noise,
                                        std::optional<double> radius_m, const RunContext& context);

}  // namespace turnscan::detection
