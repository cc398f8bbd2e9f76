#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <turnscan/capture/recorder/depth_crop.hpp>
#include <turnscan/core/parallel.hpp>

namespace turnscan {

namespace {

constexpr int kLargestRaw = kOutsideCrop - 1;

struct Span {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

/// The z for which a + b z is between low and high.
Span slab(double a, double b, double low, double high) {
  if (b == 0.0) return a > low && a < high ? Span{} : Span{1.0, 0.0};
  const double p = (low - a) / b, q = (high - a) / b;
  return {std::min(p, q), std::max(p, q)};
}

/// The z for which the point o + d z is closer to the axis than the radius.
Span tube(double ox, double oz, double dx, double dz, double radius) {
  const double a = dx * dx + dz * dz, b = ox * dx + oz * dz,
               c = ox * ox + oz * oz - radius * radius;
  if (a == 0.0) return c < 0.0 ? Span{} : Span{1.0, 0.0};
  const double square = b * b - a * c;
  if (square < 0.0) return {1.0, 0.0};
  const double root = std::sqrt(square);
  return {(-b - root) / a, (-b + root) / a};
}

/// The raw depths kept for a pixel. 0 to 0: its ray misses the cylinder.
struct Interval {
  std::uint16_t nearest = 0, farthest = 0;
};

/// A cylinder is convex, so that the depths inside it form one interval. Its ends, known to within
/// rounding, are verified with exactly the test and the point that crop() of points_of() uses.
class IntervalFinder {
 public:
  IntervalFinder(const SensorInfo& sensor, const Pose& T_table_sensor, const Cylinder& cylinder)
      : sensor_(sensor), T_(T_table_sensor), cylinder_(cylinder), crop_(cylinder, T_table_sensor) {}

  Interval find(float ray_x, float ray_y) const {
    if (!std::isfinite(ray_x) || !std::isfinite(ray_y)) return {};
    const Vec3d d = T_.linear() * Vec3d(ray_x, ray_y, 1.0);
    const Vec3d o = T_.translation();
    const Span height = slab(o.y(), d.y(), cylinder_.margin_m, cylinder_.height_m);
    const Span width = tube(o.x(), o.z(), d.x(), d.z(), cylinder_.radius_m);
    int first = raw_of(std::max(height.begin, width.begin));
    int last = raw_of(std::min(height.end, width.end));
    const auto keeps = [&](int raw) {
      return raw >= 1 && raw <= kLargestRaw && this->keeps(ray_x, ray_y, raw);
    };
    // Widened by a few steps, so that neither rounding nor a narrowly missed interval matters.
    first = std::clamp(first - kSteps, 1, kLargestRaw);
    last = std::clamp(last + kSteps, 1, kLargestRaw);
    while (first <= last && !keeps(first)) ++first;
    while (last >= first && !keeps(last)) --last;
    if (first > last) return {};
    return {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(last)};
  }

 private:
  static constexpr int kSteps = 3;

  int raw_of(double z_m) const {
    const double raw = (z_m - sensor_.depth_bias_m) / sensor_.depth_unit_m;
    return static_cast<int>(std::clamp(raw, -10.0, 65545.0));
  }

  bool keeps(float ray_x, float ray_y, int raw) const {
    const float z = static_cast<float>(raw * sensor_.depth_unit_m + sensor_.depth_bias_m);
    return z > 0.0f && crop_.keeps(Vec3f(ray_x * z, ray_y * z, z));
  }

  const SensorInfo& sensor_;
  const Pose& T_;
  const Cylinder& cylinder_;
  SensorCrop crop_;
};

}  // namespace

Result<DepthCrop> DepthCrop::create(const Cylinder& cylinder, const Pose& T_table_sensor,
                                    const SensorInfo& sensor) {
  if (sensor.kind != SensorKind::kDepthCamera)
    return fail(ErrorCode::kUnsupported, "crop: the sensor gives points, not depth images");
  TURNSCAN_TRY(sensor.intrinsics.check());
  const RayTable rays(sensor.intrinsics);
  const IntervalFinder finder(sensor, T_table_sensor, cylinder);
  DepthCrop crop;
  crop.nearest_.resize(rays.x().size());
  crop.farthest_.resize(rays.x().size());
  parallel_for(rays.x().size(), 4096, [&](std::size_t i) {
    const Interval kept = finder.find(rays.x()[i], rays.y()[i]);
    crop.nearest_[i] = kept.nearest;
    crop.farthest_[i] = kept.farthest;
  });
  return crop;
}

void DepthCrop::apply(DepthImage& image) const {
  if (image.pixels.size() != nearest_.size())
    throw std::invalid_argument("depth crop: the image does not have the sensor's size");
  std::uint16_t* pixels = image.pixels.data();
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    const std::uint16_t raw = pixels[i];
    const std::uint16_t behind = raw > farthest_[i] ? kOutsideCrop : raw;
    pixels[i] = raw < nearest_[i] ? kNoReturn : behind;
  }
}

}  // namespace turnscan
