#pragma once
// What the views of a scan saw, for whoever compares scans.

#include <optional>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan {

struct SeenSpace {
  static constexpr std::size_t kMaxViews = 40;

  std::vector<views::DepthView> views;  ///< up to so many, evenly spread
  std::optional<double> floor_m;        ///< height of the platter, where there is one
  double noise_m = 0.0;                 ///< of a depth along its ray
  double spacing_m = 0.0;               ///< of the points of one frame
  bool filtered = false;                ///< the sensor averages over its pixels (sensor_filter.hpp)
};

}  // namespace turnscan
