#include "tests/reconstruction/outliers/plain_outliers.hpp"

#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>

namespace turnscan::testing {

namespace {

/// Missing neighbours count as distance 0. The nearest point is the point itself or one at its
/// place.
std::vector<float> mean_distances(std::span<const Vec3f> points, int k) {
  const KdTree tree(points);
  std::vector<float> mean(points.size());
  parallel_for(points.size(), 256, [&](std::size_t i) {
    std::vector<std::uint32_t> index(std::size_t(k) + 1);
    std::vector<float> squared(index.size());
    const std::size_t found = tree.knn(points[i], index.size(), index.data(), squared.data());
    double sum = 0.0;
    for (std::size_t j = 1; j < found; ++j) sum += std::sqrt(double(squared[j]));
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
