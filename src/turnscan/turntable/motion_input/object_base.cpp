#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/motion_input/object_base.hpp>

namespace turnscan::motion {

namespace {

constexpr double kSlice_m = 0.002;
constexpr std::size_t kSlices = 300;
constexpr double kGap_m = 0.008;      ///< hardly a point in it: the object has ended
constexpr double kEmptyShare = 0.05;  ///< of a usual slice's points: mixed pixels are left
constexpr std::size_t kUsual = 10;    ///< slices, the first ones
constexpr double kDeskRatio = 4.0;    ///< a slice of so many times the usual points is a desk
constexpr std::size_t kFrames = 8;

/// How many points of surfaces lie in each slice below a height, within a radius of the axis.
class Slices {
 public:
  Slices(const MotionData& data, const TurntableInfo& axis, double radius_m, double top)
      : data_(data), axis_(axis), radius_m_(radius_m), top_(top) {}

  void add(const DepthImage& depth, const SensorInfo& sensor, const RayTable& rays) {
    const int w = depth.width;
    for (int y = 1; y + 1 < depth.height; ++y) {
      for (int x = 1; x + 1 < w; ++x) {
        const auto i = std::size_t(y) * std::size_t(w) + std::size_t(x);
        const double z = metres(depth.pixels[i], sensor);
        if (!(z > 0.0) || !on_surface(depth, sensor, i, z)) continue;
        const Vec3d d = Vec3d(rays.x()[i] * z, rays.y()[i] * z, z) - axis_.center_m;
        const double below = (top_ - d.dot(axis_.axis)) / kSlice_m;
        if (below < 0.0 || below >= double(kSlices)) continue;
        if (axis_.axis.cross(d).squaredNorm() < radius_m_ * radius_m_)
          count_[std::size_t(below)] += 1.0;
      }
    }
  }

  ObjectBase base() const {
    std::vector<double> first(count_.begin(), count_.begin() + kUsual);
    const double usual = median(first), least = std::max(2.0, kEmptyShare * usual);
    double end = 0.0, empty = 0.0;
    for (std::size_t k = 0; k < kSlices && count_[k] < kDeskRatio * std::max(usual, 4.0); ++k) {
      empty = count_[k] < least ? empty + kSlice_m : 0.0;
      if (empty >= kGap_m) return {top_ - end, true};
      if (empty == 0.0) end = double(k + 1) * kSlice_m;
    }
    return {top_ - end, false};
  }

 private:
  static double metres(std::uint16_t value, const SensorInfo& sensor) {
    if (value == kNoReturn || value == kOutsideCrop) return 0.0;
    return value * sensor.depth_unit_m + sensor.depth_bias_m;
  }

  bool on_surface(const DepthImage& depth, const SensorInfo& sensor, std::size_t i,
                  double z) const {
    const double limit = 3.0 * z / sensor.intrinsics.fx + 4.5 * data_.noise_m;
    const auto w = std::size_t(depth.width);
    for (const std::size_t there : {i - w, i - 1, i + 1, i + w})
      if (std::abs(metres(depth.pixels[there], sensor) - z) > limit) return false;
    return true;
  }

  const MotionData& data_;
  const TurntableInfo& axis_;
  double radius_m_, top_;
  std::vector<double> count_ = std::vector<double>(kSlices, 0.0);
};

/// The value that a share of them lies below.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

Result<ObjectBase> find_base(const MotionData& data, const TurntableInfo& axis,
                             const FrameSequence& sequence) {
  std::vector<double> heights, radii;
  for (const Vec3f& p : data.cloud) {
    const Vec3d d = p.cast<double>() - axis.center_m;
    heights.push_back(axis.axis.dot(d));
    radii.push_back(axis.axis.cross(d).norm());
  }
  if (!data.projective) return ObjectBase{quantile(std::move(heights), 0.005), true};
  const SensorInfo& sensor = sequence.header().sensors.front();
  const RayTable rays(sensor.intrinsics);
  Slices slices(data, axis, quantile(std::move(radii), 0.99), quantile(std::move(heights), 0.5));
  const std::size_t count = std::min(kFrames, data.frames.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t position = data.frames[k * data.frames.size() / count].position;
    TURNSCAN_ASSIGN(const Frame frame, sequence.read(position));
    if (frame.depth.width == sensor.intrinsics.width &&
        frame.depth.height == sensor.intrinsics.height)
      slices.add(frame.depth, sensor, rays);
  }
  return slices.base();
}

}  // namespace turnscan::motion
