#include "bench/pcl_outliers.hpp"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

namespace turnscan::testing {

struct PclOutlierFilter::Impl {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::Indices kept;
  int k;
  double lambda;
};

PclOutlierFilter::PclOutlierFilter(std::span<const Vec3f> points, int k, double lambda)
    : impl_(new Impl) {
  impl_->cloud->reserve(points.size());
  for (const Vec3f& p : points) impl_->cloud->push_back({p.x(), p.y(), p.z()});
  impl_->k = k;
  impl_->lambda = lambda;
}

PclOutlierFilter::~PclOutlierFilter() = default;

std::size_t PclOutlierFilter::run() {
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(impl_->cloud);
  filter.setMeanK(impl_->k);
  filter.setStddevMulThresh(impl_->lambda);
  filter.filter(impl_->kept);
  return impl_->kept.size();
}

std::vector<std::uint8_t> PclOutlierFilter::mask() const {
  std::vector<std::uint8_t> mask(impl_->cloud->size(), 0);
  for (const pcl::index_t i : impl_->kept) mask[std::size_t(i)] = 1;
  return mask;
}

std::vector<std::uint8_t> pcl_outlier_mask(std::span<const Vec3f> points, int k, double lambda) {
  PclOutlierFilter filter(points, k, lambda);
  filter.run();
  return filter.mask();
}

}  // namespace turnscan::testing
