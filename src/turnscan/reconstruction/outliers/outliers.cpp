#include <algorithm>
#include <cmath>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/outliers/outliers.hpp>
#include <turnscan/reconstruction/outliers/view_grid.hpp>

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

/// 1 for points with k others at the same place: their distances are 0, but a search would look at
/// all of them, thousands where a file has zeros for what was not measured.
std::vector<std::uint8_t> find_heaped(std::span<const Vec3f> points, int k) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(points[a].begin(), points[a].end(), points[b].begin(),
                                        points[b].end());
  });
  std::vector<std::uint8_t> heaped(points.size(), 0);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && points[order[end]] == points[order[begin]]) ++end;
    if (end - begin <= std::size_t(k)) continue;
    for (std::size_t i = begin; i < end; ++i) heaped[order[i]] = 1;
  }
  return heaped;
}

/// Squared distances to the nearest of points.
class Neighbours {
 public:
  Neighbours(std::span<const Vec3f> points, int k)
      : points_(points), view_(ViewGrid::build(points)) {
    if (view_) return;
    tree_ = KdTree(points);
    heaped_ = find_heaped(points, k);
  }

  /// Those of as many points as index, which is scratch, has room for, ascending. Returns their
  /// number; 0 for a point that shares its place with more than k others.
  std::size_t of(std::size_t i, std::span<std::uint32_t> index, float* squared) const {
    if (view_) return view_->nearest(points_[i], index.size(), squared);
    return heaped_[i] != 0 ? 0 : tree_.knn(points_[i], index.size(), index.data(), squared);
  }

 private:
  std::span<const Vec3f> points_;
  std::optional<ViewGrid> view_;
  KdTree tree_;
  std::vector<std::uint8_t> heaped_;
};

/// Per point the sum of the roots in double and ascending, rounded once, as PCL does. The nearest
/// point, which is the point itself or one at the same place, does not count.
Result<std::vector<float>> mean_distances(std::span<const Vec3f> points, int k,
                                          const RunContext& context) {
  constexpr std::size_t kChunk = 512;
  const Neighbours neighbours(points, k);
  std::vector<float> mean(points.size());
  const auto chunk_means = [&](std::size_t chunk) {
    std::vector<std::uint32_t> index(std::size_t(k) + 1);
    std::vector<float> squared(index.size());
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const std::size_t found = neighbours.of(i, index, squared.data());
      double sum = 0.0;
      for (std::size_t j = 1; j < found; ++j) sum += std::sqrt(double(squared[j]));
      mean[i] = static_cast<float>(sum / k);
    }
  };
  TURNSCAN_TRY(parallel_for((points.size() + kChunk - 1) / kChunk, 1, context, chunk_means));
  return mean;
}

/// In PCL's order and precision: squares are rounded to float, sums are in double.
double threshold(std::span<const float> mean, double lambda) {
  double sum = 0.0, squares = 0.0;
  for (const float d : mean) {
    sum += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(mean.size());
  return sum / n + lambda * std::sqrt((squares - sum * sum / n) / (n - 1.0));
}

}  // namespace

Result<std::vector<std::uint8_t>> statistical_outlier_mask(std::span<const Vec3f> points,
                                                           const OutlierOptions& options,
                                                           const RunContext& context) {
  TURNSCAN_TRY(check(points, options));
  std::vector<std::uint8_t> mask(points.size(), 1);
  if (!options.enabled || points.empty()) return mask;
  TURNSCAN_ASSIGN(const std::vector<float> mean,
                  mean_distances(points, options.neighbours, context));
  const double farthest = threshold(mean, options.lambda);
  // A threshold that is NaN keeps everything.
  for (std::size_t i = 0; i < mean.size(); ++i) mask[i] = !(mean[i] > farthest);
  return mask;
}

}  // namespace turnscan::outliers
