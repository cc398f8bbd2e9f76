#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/clouds/turning_disc.hpp>

namespace turnscan::motion {

namespace {

const double kDiscLevel = std::cos(10.0 * kRadiansPerDegree);
constexpr double kMinDiscShare = 0.05;  ///< of the samples
/// Half the thickness of the layer that belongs to the surface: this, or so many deviations.
constexpr double kMinLayer_m = 0.001, kLayerNoises = 4.0;
constexpr double kInside = 0.9;     ///< of the radius; farther out the platter's side is seen
constexpr double kMaxBelow = 0.01;  ///< share of the points that may lie below the disc
constexpr std::size_t kBearings = 72;
constexpr double kMinRimShare = 0.6;
constexpr double kRimWithin = 0.04;  ///< of the radius

/// A point of a cloud about the axis, in the table's frame.
struct DiscPoint {
  double height_m, radius_m, bearing_rad;
};

class DiscSearch {
 public:
  DiscSearch(const MotionData& data, const TurntableInfo& axis, std::span<const double> angles_rad)
      : data_(data), axis_(axis), across_(axis.axis.unitOrthogonal()), angles_(angles_rad) {}

  std::optional<TurningDisc> run() const {
    const auto level = most_common_level();
    if (!level) return std::nullopt;
    const double layer_m = std::max(kMinLayer_m, kLayerNoises * data_.noise_m);
    std::vector<DiscPoint> disc;
    std::vector<double> below, heights, radii;
    std::size_t count = 0;
    for (const std::size_t k : data_.keys) {
      for (const Vec3f& point : data_.frames[k].surface.points) {
        const DiscPoint p = about_axis(point, angles_[k]);
        ++count;
        if (std::abs(p.height_m - *level) < layer_m) {
          disc.push_back(p);
          heights.push_back(p.height_m);
          radii.push_back(p.radius_m);
        }
        if (p.height_m < *level - 2.0 * layer_m) below.push_back(p.radius_m);
      }
    }
    if (disc.empty()) return std::nullopt;
    TurningDisc out;
    const auto at = radii.begin() + std::ptrdiff_t(double(radii.size() - 1) * 0.995);
    std::nth_element(radii.begin(), at, radii.end());
    out.radius_m = *at;
    const auto inside = std::count_if(below.begin(), below.end(), [&](double radius_m) {
      return radius_m < kInside * out.radius_m;
    });
    if (double(inside) > kMaxBelow * double(count)) return std::nullopt;
    out.rim_share = rim_share(disc, out.radius_m);
    if (out.rim_share < kMinRimShare) return std::nullopt;
    out.height_m = median(heights);
    out.height_sigma_m = data_.noise_m;
    out.radius_sigma_m = data_.spacing_m;
    return out;
  }

 private:
  DiscPoint about_axis(const Vec3f& point, double angle_rad) const {
    const Vec3d p = point.cast<double>() - axis_.center_m;
    const double x = across_.dot(p), z = axis_.axis.cross(across_).dot(p);
    return {axis_.axis.dot(p), std::hypot(x, z), std::atan2(z, x) - angle_rad};
  }

  /// Of the samples that face up.
  std::optional<double> most_common_level() const {
    std::vector<double> heights;
    std::size_t count = 0;
    for (const MotionFrame& frame : data_.frames) {
      count += frame.samples.size();
      for (const SurfaceSample& sample : frame.samples)
        if (sample.n.cast<double>().dot(axis_.axis) > kDiscLevel)
          heights.push_back(axis_.axis.dot(sample.p.cast<double>() - axis_.center_m));
    }
    std::sort(heights.begin(), heights.end());
    const double layer_m = 2.0 * std::max(kMinLayer_m, kLayerNoises * data_.noise_m);
    std::size_t most = 0, first = 0, middle = 0;
    for (std::size_t last = 0; last < heights.size(); ++last) {
      while (heights[last] - heights[first] > layer_m) ++first;
      if (last - first >= most) most = last - first, middle = (first + last) / 2;
    }
    if (double(most) < kMinDiscShare * double(count)) return std::nullopt;
    return heights[middle];
  }

  /// A square plate reaches its largest radius at its corners only.
  static double rim_share(const std::vector<DiscPoint>& disc, double radius_m) {
    std::array<double, kBearings> farthest{};
    for (const DiscPoint& p : disc) {
      const double turns = p.bearing_rad / kTurn;
      const auto bin = std::size_t((turns - std::floor(turns)) * double(kBearings)) % kBearings;
      if (p.radius_m < radius_m * (1.0 + kRimWithin))
        farthest[bin] = std::max(farthest[bin], p.radius_m);
    }
    const auto reached = std::count_if(farthest.begin(), farthest.end(),
                                       [&](double r) { return r > radius_m * (1.0 - kRimWithin); });
    return double(reached) / double(kBearings);
  }

  const MotionData& data_;
  const TurntableInfo& axis_;
  Vec3d across_;
  std::span<const double> angles_;
};

}  // namespace

std::optional<TurningDisc> find_turning_disc(const MotionData& data, const TurntableInfo& axis,
                                             std::span<const double> angles_rad) {
  return DiscSearch(data, axis, angles_rad).run();
}

}  // namespace turnscan::motion
