#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/turntable/crop/crop_kernel.hpp>
#include <turnscan/turntable/crop/live_crop.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kWord = 64;   // pixels in a word of the kernel's answer
constexpr std::size_t kChunk = 32;  // words that are looked at before their points are made
constexpr int kLargestRaw = kOutsideCrop - 1;

struct Span {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

/// Where a + b z is between low and high.
Span slab(double a, double b, double low, double high) {
  if (b == 0.0) return a > low && a < high ? Span{} : Span{1.0, 0.0};
  const double p = (low - a) / b, q = (high - a) / b;
  return {std::min(p, q), std::max(p, q)};
}

/// Where the point o + d z is nearer to the axis than the radius.
Span tube(double ox, double oz, double dx, double dz, double radius) {
  const double a = dx * dx + dz * dz, b = ox * dx + oz * dz,
               c = ox * ox + oz * oz - radius * radius;
  if (a == 0.0) return c < 0.0 ? Span{} : Span{1.0, 0.0};
  const double square = b * b - a * c;
  if (square < 0.0) return {1.0, 0.0};
  const double root = std::sqrt(square);
  return {(-b - root) / a, (-b + root) / a};
}

/// Finds the raw values of one pixel. The ends, known to within rounding, are looked at with the
/// very test and the very point that the slow crop uses.
class IntervalFinder {
 public:
  IntervalFinder(const SensorInfo& sensor, const Pose& T_table_sensor, const Cylinder& cylinder)
      : sensor_(sensor), T_(T_table_sensor), cylinder_(cylinder), slow_(cylinder, T_table_sensor) {}

  LiveCrop::Interval find(float ray_x, float ray_y) const {
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
    // A few steps outwards, so that neither rounding nor a span that just misses matters.
    first = std::clamp(first - kSteps, 1, kLargestRaw);
    last = std::clamp(last + kSteps, 1, kLargestRaw);
    while (first <= last && !keeps(first)) ++first;
    while (last >= first && !keeps(last)) --last;
    if (first > last) return {};
    return {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(last - first + 1)};
  }

 private:
  static constexpr int kSteps = 3;

  int raw_of(double z_m) const {
    const double raw = (z_m - sensor_.depth_bias_m) / sensor_.depth_unit_m;
    return static_cast<int>(std::clamp(raw, -10.0, 65545.0));
  }

  bool keeps(float ray_x, float ray_y, int raw) const {
    const float z = static_cast<float>(raw * sensor_.depth_unit_m + sensor_.depth_bias_m);
    return z > 0.0f && slow_.keeps(Vec3f(ray_x * z, ray_y * z, z));
  }

  const SensorInfo& sensor_;
  const Pose& T_;
  const Cylinder& cylinder_;
  SensorCrop slow_;
};

}  // namespace

OptionTable describe(LiveCropOptions& o) {
  OptionTable table;
  table
      .number("live-margin", o.margin_m, Quantity::kLength, {-0.05, 0.2},
              "Height above the platter below which returns are left out")
      .number("live-inset", o.inset_m, Quantity::kLength, {-1.0, 1.0},
              "How far inside the platter's rim the cylinder ends")
      .number("live-height", o.height_m, Quantity::kLength, {1e-3, 100.0},
              "Height of the cylinder");
  return table;
}

Result<Cylinder> live_cylinder(const TurntableInfo& table, const LiveCropOptions& options) {
  LiveCropOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  if (!table.radius_m)
    return fail(ErrorCode::kMissingData,
                "crop: the platter's radius is not known; calibrate with --platter-radius");
  Cylinder cylinder;
  cylinder.margin_m = options.margin_m;
  cylinder.height_m = options.height_m;
  cylinder.radius_m = *table.radius_m - options.inset_m;
  if (!(cylinder.radius_m > 0.0) || !(cylinder.height_m > cylinder.margin_m))
    return fail(ErrorCode::kMissingData,
                "crop: nothing is left of a platter of radius {:.0f} mm; make live-inset smaller",
                1e3 * *table.radius_m);
  return cylinder;
}

Result<LiveCrop> LiveCrop::create(const SensorInfo& sensor, const Pose& T_table_sensor,
                                  const Cylinder& cylinder) {
  if (sensor.kind != SensorKind::kDepthCamera)
    return fail(ErrorCode::kUnsupported, "crop: the sensor gives points, not depth images");
  TURNSCAN_TRY(sensor.intrinsics.check());
  LiveCrop crop;
  crop.sensor_ = sensor;
  crop.rays_ = RayTable(sensor.intrinsics);
  const std::size_t n = crop.rays_.x().size();
  const std::size_t padded = (n + kWord - 1) / kWord * kWord;
  crop.first_.assign(padded, 0);
  crop.count_.assign(padded, 0);
  const IntervalFinder finder(sensor, T_table_sensor, cylinder);
  parallel_for(n, 4096, [&](std::size_t i) {
    const Interval found = finder.find(crop.rays_.x()[i], crop.rays_.y()[i]);
    crop.first_[i] = found.first;
    crop.count_[i] = found.count;
  });
  return crop;
}

Result<> LiveCrop::check(const DepthImage& depth) const {
  if (depth.width == sensor_.intrinsics.width && depth.height == sensor_.intrinsics.height &&
      depth.pixels.size() == rays_.x().size())
    return {};
  return fail(ErrorCode::kFormat, "depth image is {} x {} pixels, but its sensor has {} x {}",
              depth.width, depth.height, sensor_.intrinsics.width, sensor_.intrinsics.height);
}

LiveCrop::Interval LiveCrop::interval(int column, int row) const {
  const auto i =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(sensor_.intrinsics.width) +
      static_cast<std::size_t>(column);
  return {first_.at(i), count_.at(i)};
}

/// Calls take(position) of each kept pixel, in order.
template <class Take>
void LiveCrop::for_kept(const DepthImage& depth, const Take& take) const {
  const crop_kernel::CropKernel& kernel = crop_kernel::CropKernels::current();
  const std::size_t whole = depth.pixels.size() / kWord * kWord;
  std::array<std::uint64_t, kChunk> bits;
  const auto take_words = [&](const std::uint16_t* raw, std::size_t begin, std::size_t n) {
    kernel.select(raw, first_.data() + begin, count_.data() + begin, n, bits.data());
    for (std::size_t word = 0; word < n / kWord; ++word)
      for (std::uint64_t left = bits[word]; left != 0; left &= left - 1)
        take(begin + word * kWord + static_cast<std::size_t>(std::countr_zero(left)));
  };
  for (std::size_t begin = 0; begin < whole; begin += kChunk * kWord)
    take_words(depth.pixels.data() + begin, begin, std::min(kChunk * kWord, whole - begin));
  if (whole == depth.pixels.size()) return;
  std::array<std::uint16_t, kWord> rest{};
  std::copy(depth.pixels.begin() + static_cast<std::ptrdiff_t>(whole), depth.pixels.end(),
            rest.begin());
  take_words(rest.data(), whole, kWord);
}

Result<FramePoints> LiveCrop::points(const DepthImage& depth, const ColorImage& color) const {
  TURNSCAN_TRY(check(depth));
  FramePoints out;
  out.width = depth.width;
  out.height = depth.height;
  out.viewpoint = sensor_.viewpoint;
  const bool colored =
      !sensor_.color_intrinsics && color.width == depth.width && color.height == depth.height;
  const float* x = rays_.x().data();
  const float* y = rays_.y().data();
  for_kept(depth, [&](std::size_t i) {
    const float z =
        static_cast<float>(depth.pixels[i] * sensor_.depth_unit_m + sensor_.depth_bias_m);
    out.cloud.points.emplace_back(x[i] * z, y[i] * z, z);
    out.cell.push_back(static_cast<std::int32_t>(i));
    if (colored) out.cloud.colors.push_back(color.pixels[i]);
  });
  return out;
}

Result<DepthImage> LiveCrop::image(const DepthImage& depth) const {
  TURNSCAN_TRY(check(depth));
  DepthImage out(depth.width, depth.height);
  std::transform(depth.pixels.begin(), depth.pixels.end(), out.pixels.begin(),
                 [](std::uint16_t raw) { return raw == kNoReturn ? kNoReturn : kOutsideCrop; });
  for_kept(depth, [&](std::size_t i) { out.pixels[i] = depth.pixels[i]; });
  return out;
}

}  // namespace turnscan
