#pragma once
// Quantisation steps of a depth camera, estimated from its images.

#include <vector>

namespace turnscan::motion {

/// Distances between the depth values that a sensor can report: for triangulation they grow with
/// the square of the depth.
class DepthSteps {
 public:
  DepthSteps() = default;
  /// images: depths in metres, integer multiples of unit_m (above 0) plus a bias; 0: none.
  DepthSteps(const std::vector<std::vector<float>>& images, double unit_m);

  /// The step near a depth that was observed, metres; 0 if too few values were observed near it.
  double at(double depth_m) const;

 private:
  std::vector<float> values_;  ///< ascending
  std::vector<float> steps_;   ///< near each of them
};

}  // namespace turnscan::motion
