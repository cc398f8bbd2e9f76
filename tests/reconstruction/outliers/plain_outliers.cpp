#include "tests/reconstruction/outliers/plain_outliers.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>

namespace turnscan::testing {

namespace {

/// By definition: all squared distances sorted, the first, that of the point to itself, left out.
/// Missing neighbours count as distance 0.
std::vector<float> mean_distances(std::span<const Vec3f> points, int k) {
  const std::size_t wanted = std::min(points.size(), std::size_t(k) + 1);
  std::vector<float> mean(points.size());
  parallel_for(points.size(), 64, [&](std::size_t i) {
    std::vector<float> squared;
    for (const Vec3f& p : points) {
      const Vec3f d = points[i] - p;
      squared.push_back(d.x() * d.x() + d.y() * d.y() + d.z() * d.z());
    }
    std::nth_element(squared.begin(), squared.begin() + std::ptrdiff_t(wanted) - 1, squared.end());
    std::sort(squared.begin(), squared.begin() + std::ptrdiff_t(wanted));
    double sum = 0.0;
    for (std::size_t j = 1; j < wanted; ++j) sum += std::sqrt(double(squared[j]));
    mean[i] = float(sum / k);
  });
  return mean;
}

}  // namespace

std::vector<std::uint8_t> plain_outlier_mask(std::span<const Vec3f> points, int k, double lambda) {
  const std::vector<float> mean = mean_distances(points, k);
  double sum = 0.0, squares = 0.0;
  for (const float d : mean) {
    sum += d;
    squares += d * d;  // rounded to float, as in PCL
  }
  const auto n = double(points.size());
  const double deviation = std::sqrt((squares - sum * sum / n) / (n - 1.0));
  const double threshold = sum / n + lambda * deviation;
  std::vector<std::uint8_t> mask;
  for (const float d : mean) mask.push_back(!(d > threshold));
  return mask;
}

}  // namespace turnscan::testing
