#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/outliers/outliers.hpp>
#include <turnscan/reconstruction/outliers/outliers_grid.hpp>
#include <turnscan/reconstruction/outliers/outliers_kernel.hpp>
#include <turnscan/reconstruction/outliers/outliers_tree.hpp>

namespace turnscan::outliers {

namespace {

constexpr float kFarthest = 1e9f;

Result<> check(std::span<const Vec3f> points, const OutlierOptions& options) {
  OutlierOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Written so that NaN fails.
    if (!(points[i].cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest))
      return fail(ErrorCode::kFormat,
                  "point {}: a coordinate is not finite or beyond 1e9 m; check the file's units",
                  i);
  }
  return {};
}

/// Mean of k distances from squared ones, ascending: the sum in double, rounded once, as PCL does.
float mean_distance(const float* squared, std::size_t n, int k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += std::sqrt(double(squared[i]));
  return static_cast<float>(sum / k);
}

/// With n <= k: all others are neighbours, and the missing ones count as distance 0.
void mean_distances_of_few(std::span<const Vec3f> points, int k, std::span<float> mean) {
  std::vector<float> squared(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vec3f d = points[i] - points[j];
      squared[j] = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    }
    std::sort(squared.begin(), squared.end());
    mean[i] = mean_distance(squared.data() + 1, squared.size() - 1, k);
  }
}

/// For more neighbours than the kernels keep.
Result<> many_mean_distances(std::span<const Vec3f> points, int k, const RunContext& context,
                             std::span<float> mean) {
  constexpr std::size_t kChunk = 512;
  const KdTree tree(points);
  parallel_for((points.size() + kChunk - 1) / kChunk, 1, [&](std::size_t chunk) {
    if (context.cancelled()) return;
    const std::size_t count = std::size_t(k) + 1;
    std::vector<std::uint32_t> index(count);
    std::vector<float> squared(count);
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      tree.knn(points[i], count, index.data(), squared.data());
      mean[i] = mean_distance(squared.data() + 1, count - 1, k);
    }
  });
  return context.check();
}

/// In PCL's order and precision: squares are rounded to float, sums are in double.
OutlierStatistics statistics_of(std::span<const float> mean, double lambda) {
  double sum = 0.0, squares = 0.0;
  for (const float d : mean) {
    sum += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(mean.size());
  OutlierStatistics s;
  s.mean_m = sum / n;
  s.sd_m = std::sqrt((squares - sum * sum / n) / (n - 1.0));
  s.threshold_m = s.mean_m + lambda * s.sd_m;
  return s;
}

std::vector<std::uint8_t> mask_of(std::span<const float> mean, double lambda,
                                  OutlierStatistics* statistics) {
  const OutlierStatistics s = statistics_of(mean, lambda);
  if (statistics) *statistics = s;
  std::vector<std::uint8_t> mask(mean.size());
  // A threshold that is NaN keeps everything.
  for (std::size_t i = 0; i < mean.size(); ++i) mask[i] = !(mean[i] > s.threshold_m);
  return mask;
}

std::vector<std::uint8_t> keep_all(std::size_t n, OutlierStatistics* statistics) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (statistics) *statistics = {kNan, kNan, kNan};
  return std::vector<std::uint8_t>(n, 1);
}

void check_cells(const FramePoints& frame) {
  if (frame.cell.empty()) return;
  if (frame.cell.size() != frame.cloud.size())
    throw std::invalid_argument("statistical_outlier_mask: cells and points differ in number");
  if (frame.width < 1 || frame.height < 1)
    throw std::invalid_argument("statistical_outlier_mask: cells without a grid");
}

/// Distances of one frame; the buffer is the thread's, so that frames cost no allocation.
std::span<float> thread_buffer(std::size_t n) {
  static thread_local std::vector<float> buffer;
  if (buffer.size() < n) buffer.resize(n);
  return {buffer.data(), n};
}

}  // namespace

Result<std::vector<std::uint8_t>> statistical_outlier_mask(const FramePoints& frame,
                                                           const OutlierOptions& options,
                                                           OutlierStatistics* statistics) {
  check_cells(frame);
  const std::vector<Vec3f>& points = frame.cloud.points;
  if (!frame.cell.empty() && options.enabled &&
      points.size() > std::size_t(std::max(options.neighbours, 0))) {
    TURNSCAN_TRY(check(points, options));
    const std::span<float> mean = thread_buffer(points.size());
    if (grid_mean_distances(frame, options.neighbours, mean))
      return mask_of(mean, options.lambda, statistics);
  }
  return statistical_outlier_mask(points, options, RunContext(), statistics);
}

Result<std::vector<std::uint8_t>> statistical_outlier_mask(std::span<const Vec3f> points,
                                                           const OutlierOptions& options,
                                                           const RunContext& context,
                                                           OutlierStatistics* statistics) {
  TURNSCAN_TRY(check(points, options));
  TURNSCAN_TRY(context.check());
  if (!options.enabled || points.empty()) return keep_all(points.size(), statistics);
  std::vector<float> mean(points.size());
  if (points.size() <= std::size_t(options.neighbours))
    mean_distances_of_few(points, options.neighbours, mean);
  else if (options.neighbours <= kMaxK)
    TURNSCAN_TRY(tree_mean_distances(points, options.neighbours, context, mean));
  else
    TURNSCAN_TRY(many_mean_distances(points, options.neighbours, context, mean));
  return mask_of(mean, options.lambda, statistics);
}

}  // namespace turnscan::outliers
