#pragma once

#include <cstdint>
#include <turnscan/reconstruction/views/depth_view.hpp>
#include <utility>
#include <vector>

namespace turnscan::views {

/// Evenly spread views of a scan: every one, or every 2nd, 4th, ... of each sensor, so that memory
/// does not grow with the scan.
class ViewStore {
 public:
  static constexpr std::size_t kMaxViews = 1024, kFewViews = 64;
  static constexpr std::size_t kMaxBytes = std::size_t(256) << 20;

  void add(DepthView view, std::uint32_t sensor);
  const std::vector<DepthView>& views() const { return views_; }
  /// How many of the scan's views each of these represents.
  std::uint32_t stride() const { return stride_; }
  std::vector<DepthView> take() { return std::move(views_); }

 private:
  void thin();

  std::vector<DepthView> views_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> key_;  ///< per view: sensor, its index there
  std::vector<std::uint32_t> seen_;                           ///< per sensor
  std::uint32_t stride_ = 1;
  std::size_t bytes_ = 0;
};

}  // namespace turnscan::views
