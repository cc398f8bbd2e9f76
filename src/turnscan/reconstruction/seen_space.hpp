#pragma once
// Space observed by the views of a scan, for comparison with other scans.

#include <optional>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan {

struct SeenSpace {
  static constexpr std::size_t kMaxViews = 40;

  std::vector<views::DepthView> views;  ///< up to kMaxViews, evenly spread
  std::optional<double> floor_m;        ///< height of the platter, if there is one
  double noise_m = 0.0;                 ///< of a depth along its ray
  double spacing_m = 0.0;               ///< of the points of one frame
  bool filtered = false;  ///< the sensor averages over neighbouring pixels (sensor_filter.hpp)
};

}  // namespace turnscan
