#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/estimation/scan_statistics.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::estimation {

namespace {

/// Spacing of unordered points, from the nearest neighbour and from the eighth: the nearest of
/// randomly distributed points is only half as far as that of grid points of the same density.
void unordered_spacing(const std::vector<Vec3f>& points, FrameStatistics& out) {
  constexpr std::size_t kAround = 8;
  const KdTree tree(points);
  std::vector<double> nearest, eighth;
  const std::size_t step = std::max<std::size_t>(1, points.size() / 2000);
  for (std::size_t i = 0; i < points.size(); i += step) {
    std::array<std::uint32_t, kAround + 1> index;
    std::array<float, kAround + 1> squared;
    const std::size_t found = tree.knn(points[i], kAround + 1, index.data(), squared.data());
    if (found > 1) nearest.push_back(std::sqrt(squared[1]));
    if (found > kAround) eighth.push_back(std::sqrt(squared[kAround]));
  }
  out.spacing_m = median(nearest);
  out.even_spacing_m = median(eighth, out.spacing_m) * std::sqrt(std::numbers::pi / kAround);
}

struct Thickness {
  double sigma = 0.0;
  double density = 0.0;  ///< points per square metre
  double spread = 0.0;   ///< ratio of the extents across and along: 1 on a surface, 0 on a line
};

/// Points of line scanners with less spread are on lines, of which a ball must contain several
/// before its points per square metre are those of the surface. On thin rods those of other sensors
/// are, too, in balls of any size.
constexpr double kOnALine = 0.5;

/// Number of points of a neighbourhood that determine its thickness to some percent; of more, every
/// n-th is used.
constexpr std::size_t kPointsUsed = 2048;

/// Faces of a wall seen from two directions, both not too obliquely, are the same if these are less
/// than about a right angle apart.
constexpr float kSameSide = 0.2f;

/// The points in the order of a grid.
struct SortedPoints {
  const std::vector<Vec3f>& points;
  const voxels::VoxelGrid& grid;
  Vec3f point(std::size_t k) const { return points[grid.order()[k]]; }
  double count(std::size_t) const { return 1.0; }
};

/// The same, restricted to points seen from about one direction.
struct OneSide : SortedPoints {
  const std::vector<std::uint32_t>& frame;
  const std::vector<Vec3f>& towards_sensor;  ///< per frame
  Vec3f towards;
  double count(std::size_t k) const {
    return towards_sensor[frame[grid.order()[k]]].dot(towards) > kSameSide ? 1.0 : 0.0;
  }
};

/// Standard deviation along the normal of the items within r of p. items: those of the grid's
/// voxels.
template <class Items>
Thickness thickness_at(const Items& items, const voxels::VoxelGrid& grid, const Vec3f& p,
                       double r) {
  const Vec3d middle = p.cast<double>(), reach = Vec3d::Constant(r);
  const voxels::VoxelIndex low = grid.index_of(middle - reach);
  const voxels::VoxelIndex high = grid.index_of(middle + reach);
  Vec3d sum = Vec3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::size_t around = 0;
  double n = 0.0;
  grid.for_each_in_box(
      low, high, [&](std::uint32_t v) { around += grid.voxels()[v].end - grid.voxels()[v].begin; });
  const std::size_t step = std::max<std::size_t>(1, around / kPointsUsed);
  std::size_t skip = 0;  // points of the next voxel to skip first
  grid.for_each_in_box(low, high, [&](std::uint32_t v) {
    const voxels::VoxelGrid::Voxel& voxel = grid.voxels()[v];
    std::size_t k = voxel.begin + skip;
    for (; k < voxel.end; k += step) {
      const Vec3d d = (items.point(k) - p).template cast<double>();
      if (d.squaredNorm() > r * r) continue;
      const double w = items.count(k);
      sum += w * d;
      squares += w * d * d.transpose();
      n += w;
    }
    skip = k - voxel.end;
  });
  if (n < 8.0) return {};
  const Vec3d mean = sum / n;
  const Eigen::Matrix3d covariance = squares / n - mean * mean.transpose();
  const Vec3d extent = symmetric_eigenvalues(covariance).cwiseMax(0.0).cwiseSqrt();
  return {extent[0], n * double(step) / (std::numbers::pi * r * r),
          extent[2] > 0.0 ? extent[1] / extent[2] : 0.0};
}

/// Maximum ratio of the distance of neighbours along the surface to that across the rays; beyond it
/// a frame is dominated by the surface's slope.
constexpr double kMaxBySlope = 1.25;

/// A second difference larger than this many times the noise is a step between two surfaces.
constexpr double kJump = 3.5;
constexpr int kNoiseRounds = 6;
/// Minimum share of second differences that are not beside a step.
constexpr std::size_t kMinShareOfBends = 8, kMinBends = 16;

/// Second differences along the rows of a grid, z[i] - (z[i-1] + z[i+1]) / 2, of the depth along
/// the ray.
class GridBends {
 public:
  explicit GridBends(const FramePoints& points) : points_(points) {
    const auto& p = points.cloud.points;
    bend_.assign(p.size(), 0.0);
    inner_.assign(p.size(), 0);
    // For a scanner with parallel rays the ray direction is the viewpoint's direction.
    const Vec3f along =
        points.viewpoint.parallel ? Vec3f(points.viewpoint.value.cast<float>()) : Vec3f::UnitZ();
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      if (!follows(i) || !follows(i + 1)) continue;
      inner_[i] = 1;
      bend_[i] = std::abs((p[i] - 0.5f * (p[i - 1] + p[i + 1])).dot(along));
    }
  }

  /// Noise from all differences: on a small object most may cross steps.
  double raw_noise() const {
    std::vector<double> bends;
    for (std::size_t i = 0; i < bend_.size(); ++i) {
      if (inner_[i]) bends.push_back(bend_[i]);
    }
    return noise_of(bends);
  }

  /// Noise from the differences whose points, with both neighbours, are within a surface; nullopt
  /// if there are too few.
  std::optional<double> noise_within(double jump_m) const {
    std::vector<double> bends;
    std::size_t all = 0;
    for (std::size_t i = 1; i + 1 < bend_.size(); ++i) {
      all += inner_[i];
      if (within(i - 1, jump_m) && within(i, jump_m) && within(i + 1, jump_m))
        bends.push_back(bend_[i]);
    }
    if (bends.size() < std::max(kMinBends, all / kMinShareOfBends)) return std::nullopt;
    return noise_of(bends);
  }

  /// Median distance of neighbours.
  double spacing() const {
    return median_step([](const Vec3f& step) { return double(step.norm()); });
  }

  /// The same across the rays, which excludes noise and the surface's slope.
  double spacing_across() const {
    const Vec3f along =
        points_.viewpoint.parallel ? Vec3f(points_.viewpoint.value.cast<float>()) : Vec3f::UnitZ();
    return median_step(
        [&](const Vec3f& step) { return double((step - step.dot(along) * along).norm()); });
  }

 private:
  double median_step(const std::function<double(const Vec3f&)>& length) const {
    std::vector<double> steps;
    for (std::size_t i = 1; i < bend_.size(); ++i) {
      if (follows(i))
        steps.push_back(length(points_.cloud.points[i] - points_.cloud.points[i - 1]));
    }
    return median(steps);
  }
  bool follows(std::size_t i) const { return points_.cell[i] == points_.cell[i - 1] + 1; }
  bool within(std::size_t i, double jump_m) const { return inner_[i] && bend_[i] <= jump_m; }
  static double noise_of(std::vector<double>& bends) { return mad_sigma(bends) / std::sqrt(1.5); }

  const FramePoints& points_;
  std::vector<double> bend_;
  std::vector<std::uint8_t> inner_;  ///< has both neighbours
};

}  // namespace

FrameStatistics frame_statistics(const FramePoints& points) {
  FrameStatistics out;
  if (points.cell.empty()) {
    unordered_spacing(points.cloud.points, out);
    return out;
  }
  const GridBends bends(points);
  out.noise_m = bends.raw_noise();
  for (int round = 0; round < kNoiseRounds; ++round)
    out.noise_m = bends.noise_within(kJump * std::sqrt(1.5) * out.noise_m).value_or(out.noise_m);
  out.spacing_m = bends.spacing();
  // A frame looking along a flat part would require voxels too coarse for all the others.
  out.even_spacing_m = std::min(out.spacing_m, std::hypot(kMaxBySlope * bends.spacing_across(),
                                                          std::numbers::sqrt2 * out.noise_m));
  return out;
}

namespace {

/// Samples: thickness_of(r) returns the function from a random key to the thickness of the cloud
/// within r of the sample selected by the key, or nullopt if r is too small for a grid.
template <class ThicknessOf>
CloudStatistics statistics(double start_radius_m, double least_spread,
                           const ThicknessOf& thickness_of) {
  constexpr std::size_t kSamples = 1500;
  CloudStatistics out;
  double r = start_radius_m;
  for (int round = 0; round < 9; ++round, r *= std::numbers::sqrt2) {
    std::vector<double> sigmas(kSamples), densities(kSamples), spreads(kSamples);
    const auto thickness = thickness_of(r);
    if (!thickness) return out;
    parallel_for(kSamples, 16, [&](std::size_t s) {
      const Thickness t = (*thickness)(mix64(s));
      sigmas[s] = t.sigma;
      densities[s] = t.density;
      spreads[s] = t.spread;
    });
    out.noise_m = median(sigmas);
    const double density = median(densities);
    out.spacing_m = density > 0.0 ? 1.0 / std::sqrt(density) : 0.0;
    if (density > 0.0 && out.noise_m < r / 4.5 && median(spreads) > least_spread) break;
  }
  return out;
}

}  // namespace

CloudStatistics cloud_statistics(const voxels::MergedCloud& merged, double start_radius_m) {
  using ThicknessAt = std::function<Thickness(std::uint64_t)>;
  const auto& points = merged.cloud.points;
  return statistics(start_radius_m, kOnALine, [&](double r) -> std::optional<ThicknessAt> {
    auto built = voxels::VoxelGrid::build(points, r, RunContext());
    if (!built) return std::nullopt;
    const auto grid = std::make_shared<const voxels::VoxelGrid>(std::move(*built));
    return [grid, r, &points](std::uint64_t key) {
      return thickness_at(SortedPoints{points, *grid}, *grid, points[key % points.size()], r);
    };
  });
}

CloudStatistics cloud_statistics(const voxels::MeasuredCells& measurements, double start_radius_m) {
  using ThicknessAt = std::function<Thickness(std::uint64_t)>;
  const voxels::VoxelGrid& grid = measurements.grid;
  std::vector<std::uint64_t> sum;  // of the points up to a cell
  for (std::size_t i = 0; i < measurements.size(); ++i)
    sum.push_back((i > 0 ? sum.back() : 0) + std::uint64_t(measurements.count(i)));
  if (sum.empty()) return {};
  return statistics(start_radius_m, kOnALine, [&](double r) -> std::optional<ThicknessAt> {
    return [&, r](std::uint64_t key) {
      const auto at = std::upper_bound(sum.begin(), sum.end(), key % sum.back());
      const Vec3f p = measurements.point(std::size_t(at - sum.begin()));
      return thickness_at(measurements, grid, p, r);
    };
  });
}

CloudStatistics one_sided_statistics(const voxels::MergedCloud& merged, double start_radius_m,
                                     bool profiles) {
  using ThicknessAt = std::function<Thickness(std::uint64_t)>;
  const auto& points = merged.cloud.points;
  const auto& frame = merged.cloud.frame;
  const Vec3d middle = bounds(points).center();
  std::vector<Vec3f> towards_sensor;
  for (const Viewpoint& viewpoint : merged.viewpoints)
    towards_sensor.push_back(viewpoint.direction_from(middle).cast<float>());
  const double least_spread = profiles ? kOnALine : 0.0;
  return statistics(start_radius_m, least_spread, [&](double r) -> std::optional<ThicknessAt> {
    auto built = voxels::VoxelGrid::build(points, r, RunContext());
    if (!built) return std::nullopt;
    const auto grid = std::make_shared<const voxels::VoxelGrid>(std::move(*built));
    return [=, &points, &frame, &towards_sensor](std::uint64_t key) {
      const std::size_t i = key % points.size();
      const OneSide items{{points, *grid}, frame, towards_sensor, towards_sensor[frame[i]]};
      return thickness_at(items, *grid, points[i], r);
    };
  });
}

double frames_apart(const voxels::MergedCloud& merged, double point_spacing_m) {
  constexpr std::size_t kSamples = 2000;
  constexpr int kDoublings = 7;
  constexpr double kShare = 0.95;
  const PointCloud& cloud = merged.cloud;
  if (cloud.points.empty() || !(point_spacing_m > 0.0)) return 0.0;
  const KdTree tree(cloud.points);
  std::vector<double> distances(kSamples, 0.0);
  parallel_for(kSamples, 16, [&](std::size_t s) {
    const std::size_t i = mix64(s) % cloud.size();
    std::vector<std::pair<std::uint32_t, float>> near;
    double r = 2.0 * point_spacing_m;
    for (int round = 0; round <= kDoublings && distances[s] == 0.0; ++round, r *= 2.0) {
      tree.radius(cloud.points[i], static_cast<float>(r), near);
      for (const auto& [other, squared] : near) {
        if (cloud.frame[other] == cloud.frame[i]) continue;
        distances[s] = std::max(std::sqrt(double(squared)), 1e-9);
        break;
      }
    }
  });
  std::erase(distances, 0.0);
  if (distances.empty()) return 0.0;
  const auto at = distances.begin() + std::ptrdiff_t(kShare * double(distances.size() - 1));
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

}  // namespace turnscan::estimation
