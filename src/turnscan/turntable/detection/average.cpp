#include <algorithm>
#include <mutex>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/detection/average.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMaxFrames = 65535;

/// Sums of integers, which are exact, so that their order does not matter.
struct PixelSums {
  std::vector<std::uint64_t> value, square;
  std::vector<std::uint16_t> count;

  explicit PixelSums(std::size_t n) : value(n), square(n), count(n) {}
  void add(const DepthImage& depth) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::uint64_t raw = depth.pixels[i];
      if (raw == kNoReturn || raw == kOutsideCrop) continue;
      value[i] += raw;
      square[i] += raw * raw;
      ++count[i];
    }
  }
};

Result<PixelSums> sum_frames(const FrameSequence& sequence,
                             const std::vector<std::size_t>& positions, const SensorInfo& sensor,
                             const RunContext& context) {
  const CameraIntrinsics& camera = sensor.intrinsics;
  PixelSums sums(std::size_t(camera.width) * std::size_t(camera.height));
  std::mutex adding;
  const auto add = [&](std::size_t, const Frame& frame) -> Result<> {
    const DepthImage& depth = frame.depth;
    if (depth.width != camera.width || depth.height != camera.height)
      return fail_at(frame.info.file, ErrorCode::kFormat,
                     "depth image is {} x {} pixels, but its sensor has {} x {}", depth.width,
                     depth.height, camera.width, camera.height);
    const std::scoped_lock lock(adding);
    sums.add(depth);
    context.advance();
    return {};
  };
  TURNSCAN_TRY(read_frames(sequence, positions, context, add));
  return sums;
}

Result<std::uint32_t> common_sensor(const FrameSequence& sequence,
                                    const std::vector<std::size_t>& positions) {
  if (positions.empty() || positions.size() > kMaxFrames)
    return fail(ErrorCode::kTooFewPoints, "averaging: {} frames are given, not 1 to {}",
                positions.size(), kMaxFrames);
  const std::uint32_t sensor = sequence.frames().at(positions.front()).sensor;
  for (const std::size_t i : positions) {
    if (sequence.frames().at(i).sensor != sensor)
      return fail(ErrorCode::kInvalidOption, "averaging: the frames are of several sensors");
  }
  if (sequence.header().sensors.at(sensor).kind != SensorKind::kDepthCamera)
    return fail(ErrorCode::kUnsupported,
                "averaging: the sensor gives points, not depth images; calibrate from motion");
  return sensor;
}

}  // namespace

OptionTable describe(AverageOptions& o) {
  OptionTable table;
  table
      .number("average-frames", o.frames, {1, kMaxFrames},
              "Most frames that are averaged before the platter is looked for")
      .number("average-share", o.min_share, Quantity::kNone, {0.0, 1.0},
              "Share of the averaged frames in which a pixel must have a return");
  return table;
}

double AveragedScan::typical_noise_m() const {
  std::vector<float> values;
  for (std::size_t i = 0; i < noise_m.pixels.size(); ++i) {
    if (depth_m.pixels[i] > 0.0f && std::isfinite(noise_m.pixels[i]))
      values.push_back(noise_m.pixels[i]);
  }
  if (values.empty()) return 0.0;
  const auto quarter = values.begin() + std::ptrdiff_t(values.size() / 4);
  std::nth_element(values.begin(), quarter, values.end());
  return 1.1 * *quarter;
}

Result<AveragedScan> average_frames(const FrameSequence& sequence,
                                    const std::vector<std::size_t>& positions,
                                    const AverageOptions& options, const RunContext& context) {
  AverageOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  TURNSCAN_ASSIGN(const std::uint32_t s, common_sensor(sequence, positions));
  const SensorInfo& sensor = sequence.header().sensors[s];
  context.begin_phase("average frames", positions.size());
  TURNSCAN_ASSIGN(const PixelSums sums, sum_frames(sequence, positions, sensor, context));
  const int w = sensor.intrinsics.width, h = sensor.intrinsics.height;
  AveragedScan out;
  out.intrinsics = sensor.intrinsics;
  out.frames = positions.size();
  out.depth_m = Image<float>(w, h, 0.0f);
  out.noise_m = Image<float>(w, h, std::nanf(""));
  out.count = Image<std::uint16_t>(w, h, 0);
  const double least = std::max(1.0, options.min_share * double(positions.size()));
  std::size_t valid = 0;
  for (std::size_t i = 0; i < sums.value.size(); ++i) {
    const double n = sums.count[i];
    out.count.pixels[i] = sums.count[i];
    if (n < least) continue;
    const double mean = double(sums.value[i]) / n;
    const double z = mean * sensor.depth_unit_m + sensor.depth_bias_m;
    if (!(z > 0.0)) continue;
    ++valid;
    out.depth_m.pixels[i] = static_cast<float>(z);
    if (n < 2) continue;
    const double variance = std::max(0.0, (double(sums.square[i]) - n * mean * mean) / (n - 1.0));
    out.noise_m.pixels[i] = static_cast<float>(std::sqrt(variance) * sensor.depth_unit_m);
  }
  if (valid == 0)
    return fail(ErrorCode::kTooFewPoints, "averaging: no pixel has a return in enough frames");
  return out;
}

std::vector<std::size_t> spread_positions(const FrameSequence& sequence, std::uint32_t sensor,
                                          std::size_t count) {
  return evenly_spread(usable_frames(sequence, {.sensor = sensor}), count);
}

FramePoints points_of(const AveragedScan& scan) {
  const RayTable rays(scan.intrinsics);
  FramePoints out;
  out.width = scan.depth_m.width;
  out.height = scan.depth_m.height;
  for (std::size_t i = 0; i < scan.depth_m.pixels.size(); ++i) {
    const float z = scan.depth_m.pixels[i];
    const Vec3f p(rays.x()[i] * z, rays.y()[i] * z, z);
    if (!(z > 0.0f) || !p.allFinite()) continue;
    out.cloud.points.push_back(p);
    out.cell.push_back(static_cast<std::int32_t>(i));
  }
  return out;
}

}  // namespace turnscan
