#include <algorithm>
#include <array>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/motion_input/point_sampling.hpp>

namespace turnscan::motion {

namespace {

constexpr std::uint64_t kSamplingSeed = 0x6d6f74696f6eULL;
/// Maximum number of points of a scan: more take time to search without improving its pose.
constexpr std::size_t kMaxScanPoints = 150000;

/// A random subset of about `most` points: every n-th of a grid would select its columns.
std::vector<Vec3f> thin_out(std::vector<Vec3f> points, std::size_t most, std::uint64_t seed) {
  if (points.size() <= most) return points;
  const double share = double(most) / double(points.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (uniform01(hash_key(seed, i)) < share) points[kept++] = points[i];
  points.resize(kept);
  return points;
}

class FrameLoader {
 public:
  FrameLoader(const FrameSequence& sequence, const MotionDataOptions& options,
              const RunContext& context)
      : sequence_(sequence), options_(options), context_(context) {}

  Result<MotionData> run() {
    TURNSCAN_TRY(choose_frames());
    const SensorInfo& sensor = sequence_.header().sensors.front();
    data_.projective = sensor.kind == SensorKind::kDepthCamera;
    data_.camera = sensor.intrinsics;
    if (data_.projective) {
      rays_ = RayTable(sensor.intrinsics);
      TURNSCAN_ASSIGN(foreground_, find_foreground(sequence_, options_, data_, context_));
    }
    TURNSCAN_TRY(read_all());
    if (options_.level && data_.platter) level_frames();
    return finish();
  }

 private:
  Result<> choose_frames() {
    if (sequence_.header().sensors.empty())
      return fail(ErrorCode::kMissingData, "the recording has no sensor");
    positions_ = usable_frames(sequence_, {.sensor = 0});
    for (const std::size_t i : positions_) {
      const FrameInfo& info = sequence_.frames()[i];
      MotionFrame frame;
      frame.position = i;
      frame.time_s = info.time_s;
      frame.nominal_rad = info.angle_rad;
      frame.pass = info.pass;
      data_.frames.push_back(std::move(frame));
    }
    const std::size_t n = data_.frames.size(), keys = std::min(n, options_.max_keys);
    if (n < 3)
      return fail(ErrorCode::kTooFewPoints,
                  "motion: the recording has {} usable frames of its first sensor; 3 are needed",
                  n);
    for (std::size_t k = 0; k < keys; ++k)
      data_.keys.push_back(keys == 1 ? 0 : k * (n - 1) / (keys - 1));
    return {};
  }

  std::size_t samples_per_frame(bool key) const {
    const std::size_t n = data_.frames.size();
    // More add little: noise is smoothed over 25 pixels, so that nearby samples share theirs.
    // The nearest point of a scan costs more to find than that of a depth image, and is more
    // informative.
    const std::size_t most = n > 24 ? 1500 : data_.projective ? 4000 : 2000;
    return std::clamp<std::size_t>(150000 / n, key ? 400 : 350, most);
  }

  Result<> read_all() {
    context_.begin_phase("sample frames", data_.frames.size());
    std::vector<std::uint8_t> is_key(data_.frames.size(), 0);
    for (const std::size_t k : data_.keys) is_key[k] = 1;
    std::vector<std::vector<Vec3f>> clouds(data_.frames.size());
    const auto take = [&](std::size_t i, const Frame& raw) -> Result<> {
      TURNSCAN_TRY(take_frame(raw, is_key[i] != 0, data_.frames[i], clouds[i]));
      context_.advance();
      return {};
    };
    TURNSCAN_TRY(read_frames(sequence_, positions_, context_, take));
    for (const auto& cloud : clouds)
      data_.cloud.insert(data_.cloud.end(), cloud.begin(), cloud.end());
    return {};
  }

  Result<> take_frame(const Frame& raw, bool key, MotionFrame& frame,
                      std::vector<Vec3f>& cloud) const {
    const auto seed = hash_key(kSamplingSeed, frame.position);
    if (data_.projective) {
      take_depth(raw, key, seed, frame, cloud);
      return {};
    }
    return take_points(raw, key, seed, frame, cloud);
  }

  void take_depth(const Frame& raw, bool key, std::uint64_t seed, MotionFrame& frame,
                  std::vector<Vec3f>& cloud) const {
    const double fx = data_.camera.fx, noise = data_.noise_m;
    DepthForeground depth = extract_foreground(raw.depth, sequence_.header().sensors.front(),
                                               data_.camera, rays_, foreground_);
    if (data_.platter && (options_.sights || options_.level))
      frame.platter =
          fit_platter(raw.depth, sequence_.header().sensors.front(), rays_, *data_.platter, noise);
    drop_mixed_pixels(depth, fx, noise);
    if (data_.correlated_noise) {
      const auto before = double(depth.pixels.size());
      drop_outline(depth, fx, noise);
      frame.inner_share = double(depth.pixels.size()) / std::max(before, 1.0);
    }
    frame.raw_surface = raw_surface(depth);
    if (!data_.correlated_noise) mark_inner(frame.raw_surface, fx, noise);
    smooth_depth(depth, fx, noise);
    sample_depth(data_, rays_, depth, seed, samples_per_frame(key), frame, cloud);
    if (!key) return;
    correct_chord_sag(depth, fx, noise);
    frame.surface = trimmed(depth, depth.covered);
  }

  /// A wobbling platter carries the object with it.
  void level_frames() {
    std::vector<std::optional<PlatterObservation>> sights;
    for (const MotionFrame& frame : data_.frames) sights.push_back(frame.platter);
    const auto levelling = level(sights, *data_.platter);
    if (!levelling) return;
    data_.platter->axis = levelling->axis;
    for (std::size_t i = 0; i < data_.frames.size(); ++i) {
      MotionFrame& frame = data_.frames[i];
      const Pose& T = levelling->T_level_sensor[i];
      for (SurfaceSample& sample : frame.samples) {
        sample.p = (T * sample.p.cast<double>()).cast<float>();
        sample.n = (T.linear() * sample.n.cast<double>()).cast<float>();
      }
      frame.surface.T_camera_level = T.inverse();
      frame.raw_surface.T_camera_level = T.inverse();
    }
  }

  /// The measured surface, corrected only for the effect of the sensor's own filter on curvature.
  FrameSurface raw_surface(DepthForeground& depth) const {
    if (!data_.correlated_noise) return trimmed(depth);
    const std::vector<float> filtered = depth.surface.z;
    correct_filter_sag(depth, data_.camera.fx, data_.noise_m);
    FrameSurface out = trimmed(depth);
    depth.surface.z = filtered;
    return out;
  }

  Result<> take_points(const Frame& raw, bool key, std::uint64_t seed, MotionFrame& frame,
                       std::vector<Vec3f>& cloud) const {
    const SensorInfo& sensor = sequence_.header().sensors.front();
    TURNSCAN_ASSIGN(FramePoints points, points_of(raw, sensor, RayTable()));
    if (points.cloud.points.size() < 50) return {};
    FrameSurface surface;
    surface.points = thin_out(std::move(points.cloud.points), kMaxScanPoints, seed);
    surface.tree = KdTree(surface.points);
    sample_points(surface, points.viewpoint, seed, samples_per_frame(key), frame, cloud);
    if (key) frame.surface = std::move(surface);
    return {};
  }

  Result<MotionData> finish() {
    std::size_t with = 0;
    for (const MotionFrame& frame : data_.frames) with += frame.samples.size() >= 30 ? 1 : 0;
    if (with < 3)
      return fail(ErrorCode::kTooFewPoints,
                  "motion: {} of {} frames show enough of an object; check that something stands "
                  "on the platter",
                  with, data_.frames.size());
    double count = 0.0, spacing = 0.0;
    for (const Vec3f& p : data_.cloud) {
      data_.middle += p.cast<double>();
      spacing += p.z();
      count += 1.0;
    }
    data_.middle /= count;
    data_.inner_share = 0.0;
    for (const MotionFrame& frame : data_.frames)
      data_.inner_share += frame.inner_share / double(data_.frames.size());
    double squares = 0.0;
    for (const Vec3f& p : data_.cloud) squares += (p.cast<double>() - data_.middle).squaredNorm();
    data_.extent_m = std::max(0.005, 2.0 * std::sqrt(squares / count));
    data_.to_sensor = sequence_.header().sensors.front().viewpoint.direction_from(data_.middle);
    if (data_.projective) {
      data_.spacing_m = spacing / count / data_.camera.fx;
    } else {
      measure_points();
    }
    return std::move(data_);
  }

  /// Spacing and noise of point scans, from the neighbours of some of the points.
  void measure_points() {
    std::vector<double> distances;
    for (const std::size_t k : data_.keys) {
      const FrameSurface& surface = data_.frames[k].surface;
      for (std::size_t s = 0; s < data_.frames[k].samples.size(); s += 20) {
        std::array<std::uint32_t, 2> index{};
        std::array<float, 2> squared{};
        if (surface.tree.knn(data_.frames[k].samples[s].p, 2, index.data(), squared.data()) == 2)
          distances.push_back(std::sqrt(double(squared[1])));
      }
    }
    data_.spacing_m = median(distances);
    data_.noise_m = std::max(0.1 * data_.spacing_m, 1e-5);
  }

  const FrameSequence& sequence_;
  const MotionDataOptions& options_;
  const RunContext& context_;
  std::vector<std::size_t> positions_;  ///< of data_.frames
  RayTable rays_;
  Foreground foreground_;
  MotionData data_;
};

Eigen::Vector2d pixel_of(const CameraIntrinsics& camera, const Vec3d& p) {
  if (camera.distorted()) return camera.project(p);
  return {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
}

}  // namespace

bool MotionData::find_correspondence(const FrameSurface& surface, const Vec3d& p, double reach_m,
                                     Vec3d& found) const {
  if (surface.T_camera_level) {
    if (!find_in_image(surface, *surface.T_camera_level * p, reach_m, found)) return false;
    found = surface.T_camera_level->inverse() * found;
    return true;
  }
  if (!projective) {
    std::uint32_t index = 0;
    float squared = 0.0f;
    if (surface.tree.knn(p.cast<float>(), 1, &index, &squared, float(reach_m)) == 0) return false;
    found = surface.points[index].cast<double>();
    return true;
  }
  return find_in_image(surface, p, reach_m, found);
}

bool MotionData::find_in_image(const FrameSurface& surface, const Vec3d& p, double reach_m,
                               Vec3d& found) const {
  if (!(p.z() > 0.0)) return false;
  const Eigen::Vector2d uv = pixel_of(camera, p);
  const double fx = uv.x() - surface.left, fy = uv.y() - surface.top;
  if (!(fx >= 0.0 && fy >= 0.0 && fx < surface.width - 1 && fy < surface.height - 1)) return false;
  const int x = int(fx), y = int(fy);
  const float* row = &surface.z[std::size_t(y) * std::size_t(surface.width) + std::size_t(x)];
  const float a = row[0], b = row[1], c = row[surface.width], d = row[surface.width + 1];
  const float low = std::min(std::min(a, b), std::min(c, d)),
              high = std::max(std::max(a, b), std::max(c, d));
  if (!(low > 0.0f) || high - low > 3.0 * spacing_m + 5.0 * noise_m) return false;
  const double u = fx - x, v = fy - y;
  const double z = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
  if (std::abs(z - p.z()) > reach_m) return false;
  found = p * (z / p.z());
  return true;
}

bool MotionData::within_outline(const FrameSurface& surface, const Vec3d& p) const {
  const Vec3d q = surface.T_camera_level ? *surface.T_camera_level * p : p;
  const Eigen::Vector2d uv = pixel_of(camera, q);
  const auto x = std::size_t(uv.x() - surface.left), y = std::size_t(uv.y() - surface.top);
  const std::size_t i = y * std::size_t(surface.width) + x, below = i + std::size_t(surface.width);
  return surface.inner[i] != 0 && surface.inner[i + 1] != 0 && surface.inner[below] != 0 &&
         surface.inner[below + 1] != 0;
}

Result<MotionData> load_motion(const FrameSequence& sequence, const MotionDataOptions& options,
                               const RunContext& context) {
  PlatterMemory own;
  MotionDataOptions loading = options;
  if (loading.memory == nullptr) loading.memory = &own;
  auto data = FrameLoader(sequence, loading, context).run();
  if (data || data.error().code != ErrorCode::kTooFewPoints || !loading.memory->platter)
    return data;
  // Nothing stands on the supposed platter.
  *loading.memory = {true, std::nullopt};
  return FrameLoader(sequence, loading, context).run();
}

}  // namespace turnscan::motion
