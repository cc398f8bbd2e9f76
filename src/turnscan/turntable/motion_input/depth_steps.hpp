#pragma once
// The steps in which a depth camera tells depth, as its images show them.

#include <vector>

namespace turnscan::motion {

/// Distances between the depths that a sensor can tell: those of triangulation grow with the square
/// of the depth.
class DepthSteps {
 public:
  DepthSteps() = default;
  /// images: depths in metres, whole multiples of unit_m (above 0) beside a bias; 0: none.
  DepthSteps(const std::vector<std::vector<float>>& images, double unit_m);

  /// About a depth that was seen, metres; 0 where too few were seen about it.
  double at(double depth_m) const;

 private:
  std::vector<float> values_;  ///< ascending
  std::vector<float> steps_;   ///< about each of them
};

}  // namespace turnscan::motion
