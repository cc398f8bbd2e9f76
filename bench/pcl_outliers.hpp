#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::testing {

/// What pcl::StatisticalOutlierRemoval keeps of an unorganised cloud: 1 to keep, per point.
std::vector<std::uint8_t> pcl_outlier_mask(std::span<const Vec3f> points, int k, double lambda);

/// The same for a benchmark: the cloud is converted once, outside the measured part.
class PclOutlierFilter {
 public:
  PclOutlierFilter(std::span<const Vec3f> points, int k, double lambda);
  ~PclOutlierFilter();
  PclOutlierFilter(const PclOutlierFilter&) = delete;
  PclOutlierFilter& operator=(const PclOutlierFilter&) = delete;
  /// Number of points kept.
  std::size_t run();
  std::vector<std::uint8_t> mask() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan::testing
