#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/recording/filled_depth.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMaxSampledFrames = 12;
constexpr std::uint64_t kMinRims = 200;
constexpr float kMinStrip_px = 6.0f;
constexpr float kRim_px = 0.7f;    // disparity step between neighbours that counts as a rim
constexpr float kFarthest = 1.5f;  // maximum distance, in strip widths, of the beginning of the far
                                   // surface
constexpr float kStripMargin = 0.2f;  // share of the strip excluded at both its ends

struct Strips {
  std::uint64_t rims = 0, pixels = 0, filled = 0;

  Strips& operator+=(const Strips& o) {
    rims += o.rims, pixels += o.pixels, filled += o.filled;
    return *this;
  }
};
using BothSides = std::array<Strips, 2>;

/// Disparities of a row, 0 if there is no return or one outside the crop. Reversed: for the other
/// side of the foreground.
class Row {
 public:
  Row(const DepthImage& depth, int row, float scale, float bias_steps, bool reversed) {
    disparity_.reserve(std::size_t(depth.width));
    for (int x = 0; x < depth.width; ++x) {
      const std::uint16_t raw = depth.at(reversed ? depth.width - 1 - x : x, row);
      const float steps = float(raw) + bias_steps;
      const bool there = raw != kNoReturn && raw != kOutsideCrop && steps > 0.0f;
      disparity_.push_back(there ? scale / steps : 0.0f);
    }
  }

  /// The strips to the left of rims.
  Strips strips() const {
    Strips out;
    for (int x = 1; x < int(disparity_.size()); ++x) {
      const float near = disparity_[std::size_t(x)];
      if (near == 0.0f || near - disparity_[std::size_t(x - 1)] < kRim_px) continue;
      if (const float width = strip_at(x); width > 0.0f) add(x, width, out);
    }
    return out;
  }

 private:
  /// Width of the strip beside the rim at x; 0 without a far surface close by.
  float strip_at(int x) const {
    const float near = disparity_[std::size_t(x)];
    const int reach = std::min(x, int(kFarthest * near) + 2);
    for (int k = 1; k <= reach; ++k) {
      const float far = disparity_[std::size_t(x - k)];
      if (far == 0.0f) continue;
      const float width = near - far;
      if (width >= kMinStrip_px && float(k) <= kFarthest * width + 2.0f) return width;
    }
    return 0.0f;
  }

  void add(int x, float width, Strips& out) const {
    const int first = std::max(0, x - int((1.0f - kStripMargin) * width));
    const int last = x - 1 - int(kStripMargin * width);
    ++out.rims;
    for (int p = first; p <= last; ++p) {
      ++out.pixels;
      out.filled += disparity_[std::size_t(p)] > 0.0f ? 1 : 0;
    }
  }

  std::vector<float> disparity_;
};

BothSides strips_of(const DepthImage& depth, const SensorInfo& sensor, double baseline_m) {
  const auto scale = float(sensor.intrinsics.fx * baseline_m / sensor.depth_unit_m);
  const auto bias = float(sensor.depth_bias_m / sensor.depth_unit_m);
  BothSides out;
  for (int y = 0; y < depth.height; y += 2)
    for (const bool reversed : {false, true})
      out[reversed ? 1 : 0] += Row(depth, y, scale, bias, reversed).strips();
  return out;
}

}  // namespace

Result<std::optional<double>> filled_share(const FrameSequence& sequence, std::uint32_t sensor,
                                           double baseline_m, const RunContext& context) {
  const SensorInfo& info = sequence.header().sensors.at(sensor);
  if (info.kind != SensorKind::kDepthCamera || !(baseline_m > 0.0)) return std::optional<double>();
  const auto positions =
      evenly_spread(usable_frames(sequence, {.sensor = sensor}), kMaxSampledFrames);
  std::vector<BothSides> each(positions.size());
  const auto measure = [&](std::size_t i, const Result<Frame>& frame) -> Result<> {
    if (frame) each[i] = strips_of(frame->depth, info, baseline_m);
    return {};
  };
  TURNSCAN_TRY(read_frames(sequence, positions, context, measure));
  BothSides all;
  for (const BothSides& one : each)
    for (std::size_t side = 0; side < all.size(); ++side) all[side] += one[side];
  double least = 1.0;
  for (const Strips& side : all) {
    if (side.rims < kMinRims || side.pixels == 0) return std::optional<double>();
    least = std::min(least, double(side.filled) / double(side.pixels));
  }
  return std::optional(least);
}

}  // namespace turnscan
