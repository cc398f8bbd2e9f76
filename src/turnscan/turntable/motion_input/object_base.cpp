#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/motion_input/object_base.hpp>

namespace turnscan::motion {

namespace {

constexpr double kSlice_m = 0.002;
constexpr double kGap_m = 0.008;    ///< without a point: the object has ended
constexpr double kDeepest_m = 0.3;  ///< below what moves
constexpr std::size_t kFrames = 8;
/// A slice with so many times the points of those above it is a desk.
constexpr double kDeskRatio = 4.0;

/// How many points lie in each slice below the lowest moving one, within a radius of the axis.
class Slices {
 public:
  Slices(const TurntableInfo& axis, double radius_m, double lowest)
      : axis_(axis), radius_m_(radius_m), lowest_(lowest) {}

  void add(const DepthImage& depth, const SensorInfo& sensor, const RayTable& rays) {
    for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
      const std::uint16_t value = depth.pixels[i];
      if (value == kNoReturn || value == kOutsideCrop) continue;
      const double z = value * sensor.depth_unit_m + sensor.depth_bias_m;
      const Vec3d d = Vec3d(rays.x()[i] * z, rays.y()[i] * z, z) - axis_.center_m;
      const double below = lowest_ - d.dot(axis_.axis);
      if (below < -10.0 * kSlice_m || below >= kDeepest_m) continue;
      if (axis_.axis.cross(d).squaredNorm() > radius_m_ * radius_m_) continue;
      count_[std::size_t(below / kSlice_m + 10.0)] += 1.0;
    }
  }

  /// How far below the lowest moving point the object goes on.
  double depth_of_object() const {
    std::vector<double> above(count_.begin(), count_.begin() + 10);
    const double usual = std::max(median(above), 4.0);
    double end = 0.0, empty = 0.0;
    for (std::size_t k = 10; k < count_.size(); ++k) {
      if (count_[k] > kDeskRatio * usual) break;
      empty = count_[k] < 0.02 * usual ? empty + kSlice_m : 0.0;
      if (empty >= kGap_m) break;
      if (empty == 0.0) end = (double(k) - 9.0) * kSlice_m;
    }
    return end;
  }

 private:
  const TurntableInfo& axis_;
  double radius_m_, lowest_;
  std::vector<double> count_ = std::vector<double>(std::size_t(kDeepest_m / kSlice_m) + 11, 0.0);
};

double radius_of(const MotionData& data, const TurntableInfo& axis) {
  std::vector<double> radii;
  for (const Vec3f& p : data.cloud)
    radii.push_back(axis.axis.cross(p.cast<double>() - axis.center_m).norm());
  const auto wide = radii.begin() + std::ptrdiff_t(radii.size() * 99 / 100);
  std::nth_element(radii.begin(), wide, radii.end());
  return *wide;
}

}  // namespace

Result<double> find_base(const MotionData& data, const TurntableInfo& axis,
                         const FrameSequence& sequence, double lowest) {
  if (!data.projective || data.cloud.empty()) return lowest;
  const SensorInfo& sensor = sequence.header().sensors.front();
  const RayTable rays(sensor.intrinsics);
  Slices slices(axis, radius_of(data, axis), lowest);
  for (std::size_t k = 0; k < std::min(kFrames, data.frames.size()); ++k) {
    const std::size_t i = k * data.frames.size() / std::min(kFrames, data.frames.size());
    TURNSCAN_ASSIGN(const Frame frame, sequence.read(data.frames[i].position));
    if (frame.depth.width == sensor.intrinsics.width &&
        frame.depth.height == sensor.intrinsics.height)
      slices.add(frame.depth, sensor, rays);
  }
  return lowest - slices.depth_of_object();
}

}  // namespace turnscan::motion
