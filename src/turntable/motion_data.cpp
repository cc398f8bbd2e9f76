#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/motion_data.hpp>

namespace turnscan::detail {

namespace {

constexpr std::size_t kLooks = 36;  ///< frames that are averaged first
/// Half width of the surface that a normal is taken over. A wider one would give normals of noses
/// and ears that lie so far off that steps towards the angles overshoot.
constexpr double kWindow_m = 0.004;
constexpr std::uint64_t kSeed = 0x6d6f74696f6eULL;

struct Normal {
  Vec3d n;
  double sigma;
};

/// The plane through the depth values of a window, in inverse depth.
std::optional<Normal> normal_at(const std::vector<float>& z, int width, int height, int x, int y,
                                int reach, const CameraIntrinsics& camera, double noise_m,
                                double spacing_m) {
  const float middle = z[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  if (x < reach || y < reach || x + reach >= width || y + reach >= height) return std::nullopt;
  const double limit = 2.5 * spacing_m * reach + 4.0 * noise_m;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vec3d right = Vec3d::Zero();
  int count = 0;
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const float there = z[std::size_t(y + v) * std::size_t(width) + std::size_t(x + u)];
      if (!(there > 0.0f) || std::abs(there - middle) > limit) continue;
      const Vec3d a(u, v, 1.0);
      sum += a * a.transpose();
      right += a / double(there);
      ++count;
    }
  }
  const int all = (2 * reach + 1) * (2 * reach + 1);
  if (4 * count < 3 * all) return std::nullopt;
  const Vec3d m = sum.ldlt().solve(right);
  // A mixed pixel lies off the plane of its neighbours.
  double squares = 0.0;
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const float there = z[std::size_t(y + v) * std::size_t(width) + std::size_t(x + u)];
      if (!(there > 0.0f) || std::abs(there - middle) > limit) continue;
      const double off = there - 1.0 / (m.x() * u + m.y() * v + m.z());
      squares += off * off;
    }
  }
  const double rms = std::sqrt(squares / std::max(1, count - 3));
  if (rms > 2.0 * noise_m + 0.25 * spacing_m) return std::nullopt;
  if (std::abs(middle - 1.0 / m.z()) > 3.5 * noise_m + 0.25 * spacing_m) return std::nullopt;
  // 1/z = m . (u, v, 1) with u = fx X/Z + cx - x: multiply out for the plane's normal.
  Normal out;
  out.n = Vec3d(camera.fx * m.x(), camera.fy * m.y(), 0.0);
  out.n.z() = m.z();
  out.sigma = noise_m / (spacing_m * std::sqrt(std::max(1.0, sum(0, 0))));
  return out;
}

/// Turns m of normal_at, given about pixel (x, y), into the unit normal towards the sensor.
Vec3d unit_normal(const Vec3d& scaled, const Vec3d& ray, const Vec3d& p) {
  // 1 = gx (X - ray.x Z) + gy (Y - ray.y Z) + c Z: the normal is (gx, gy, c - gx ray.x - gy ray.y).
  Vec3d n(scaled.x(), scaled.y(), scaled.z() - scaled.x() * ray.x() - scaled.y() * ray.y());
  n.normalize();
  return n.dot(p) > 0.0 ? Vec3d(-n) : n;
}

class Loader {
 public:
  Loader(const FrameSequence& sequence, const MotionDataOptions& options, const RunContext& context)
      : sequence_(sequence), options_(options), context_(context) {}

  Result<MotionData> run() {
    TURNSCAN_TRY(choose_frames());
    const SensorInfo& sensor = sequence_.header().sensors.front();
    data_.projective = sensor.kind == SensorKind::kDepthCamera;
    data_.camera = sensor.intrinsics;
    if (data_.projective) {
      rays_ = RayTable(sensor.intrinsics);
      TURNSCAN_TRY(look());
    }
    TURNSCAN_TRY(read_all());
    return finish();
  }

 private:
  Result<> choose_frames() {
    if (sequence_.header().sensors.empty())
      return fail(ErrorCode::kMissingData, "the recording has no sensor");
    const auto& infos = sequence_.frames();
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (infos[i].status != FrameStatus::kOk || infos[i].sensor != 0) continue;
      MotionFrame frame;
      frame.position = i;
      frame.time_s = infos[i].time_s;
      frame.nominal_rad = infos[i].angle_rad;
      frame.pass = infos[i].pass;
      data_.frames.push_back(std::move(frame));
    }
    const std::size_t n = data_.frames.size(), keys = std::min(n, options_.most_keys);
    if (n < 3)
      return fail(ErrorCode::kTooFewPoints,
                  "motion: the recording has {} usable frames of its first sensor; 3 are needed",
                  n);
    for (std::size_t k = 0; k < keys; ++k)
      data_.keys.push_back(keys == 1 ? 0 : k * (n - 1) / (keys - 1));
    return {};
  }

  /// The platter, or else what moves, in frames spread over the recording.
  Result<> look() {
    AverageOptions average;
    average.min_share = 0.3;
    std::vector<std::size_t> positions;
    const std::size_t n = data_.frames.size(), looks = std::min(kLooks, n);
    for (std::size_t k = 0; k < looks; ++k)
      positions.push_back(data_.frames[k * n / looks].position);
    TURNSCAN_ASSIGN(const AveragedScan scan,
                    average_frames(sequence_, positions, average, context_));
    pixels_ = pixels_of(scan);
    data_.noise_m =
        std::max(scan.typical_noise_m(), sequence_.header().sensors[0].depth_unit_m * 0.3);
    const auto platter = detect_platter(scan, options_.detect, context_);
    if (!platter && platter.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(platter.error());
    if (platter) {
      data_.platter = *platter;
      crop_to(platter->axis, platter->center_m, platter->radius_m, platter->plane_rms_m);
    } else if (options_.hint) {
      crop_to(options_.hint->axis.normalized(), options_.hint->center_m,
              options_.hint->radius_m.value_or(0.3), 0.002);
    } else {
      data_.notes.push_back(
          "no platter was seen: what turns was told from what stands still by "
          "its motion");
      return find_moving(scan);
    }
    return {};
  }

  void crop_to(const Vec3d& axis, const Vec3d& center, double radius, double spread) {
    foreground_.plane = Plane{axis, axis.dot(center)};
    foreground_.center = center;
    foreground_.radius_m = radius;
    foreground_.margin_m = std::max({0.003, 4.0 * data_.noise_m, std::min(4.0 * spread, 0.01)});
    foreground_.left = foreground_.top = 0;
    foreground_.right = data_.camera.width;
    foreground_.bottom = data_.camera.height;
    // The cylinder above the platter, half as high again as wide, in the image.
    const Pose T = frame_of(axis, center);
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (int k = 0; k < 72; ++k) {
      const double a = 0.0872664626 * k;
      for (const double h : {0.0, 3.0 * radius}) {
        const Vec3d p = T * Vec3d(radius * std::cos(a), h, radius * std::sin(a));
        if (p.z() < 0.05) return;
        const Eigen::Vector2d uv = data_.camera.project(p);
        low = low.cwiseMin(uv);
        high = high.cwiseMax(uv);
      }
    }
    foreground_.left = std::clamp(int(low.x()) - 2, 0, data_.camera.width - 1);
    foreground_.top = std::clamp(int(low.y()) - 2, 0, data_.camera.height - 1);
    foreground_.right = std::clamp(int(high.x()) + 3, foreground_.left + 1, data_.camera.width);
    foreground_.bottom = std::clamp(int(high.y()) + 3, foreground_.top + 1, data_.camera.height);
  }

  static Pose frame_of(const Vec3d& axis, const Vec3d& center) {
    Pose T = Pose::Identity();
    const Vec3d x = (std::abs(axis.x()) < 0.9 ? Vec3d::UnitX() : Vec3d::UnitZ()).cross(axis);
    T.linear().col(0) = x.normalized();
    T.linear().col(1) = axis;
    T.linear().col(2) = x.normalized().cross(axis);
    T.translation() = center;
    return T;
  }

  /// Pixels between others that flicker, row by row and column by column.
  Result<> find_moving(const AveragedScan& scan) {
    const int w = scan.depth_m.width, h = scan.depth_m.height;
    const double limit = std::max(4.0 * data_.noise_m, 0.003);
    std::vector<std::uint8_t> moving(std::size_t(w) * std::size_t(h), 0);
    std::vector<double> depths;
    const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(w) + std::size_t(x); };
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const bool partly = scan.count.pixels[i] > 0 && scan.count.pixels[i] < scan.frames;
      moving[i] = scan.noise_m.pixels[i] > limit || (partly && scan.depth_m.pixels[i] > 0.0f);
      if (moving[i] && scan.depth_m.pixels[i] > 0.0f) depths.push_back(scan.depth_m.pixels[i]);
    }
    if (depths.size() < 100)
      return fail(ErrorCode::kTooFewPoints,
                  "motion: nothing turns in the recording, or nothing that can be seen to turn");
    const auto far = depths.begin() + std::ptrdiff_t(depths.size() * 9 / 10);
    std::nth_element(depths.begin(), far, depths.end());
    foreground_.farthest_m = float(*far + 0.03);
    std::vector<std::uint8_t> rows(moving.size(), 0), columns(moving.size(), 0);
    fill_between(w, h, at, moving, rows, false);
    fill_between(w, h, at, moving, columns, true);
    for (std::size_t i = 0; i < moving.size(); ++i) rows[i] = rows[i] && columns[i] ? 1 : 0;
    foreground_.mask = std::move(rows);
    foreground_.left = w, foreground_.top = h;
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        if (!foreground_.mask[at(x, y)]) continue;
        foreground_.left = std::min(foreground_.left, x);
        foreground_.right = std::max(foreground_.right, x + 1);
        foreground_.top = std::min(foreground_.top, y);
        foreground_.bottom = std::max(foreground_.bottom, y + 1);
      }
    }
    return {};
  }

  template <class At>
  static void fill_between(int w, int h, const At& at, const std::vector<std::uint8_t>& in,
                           std::vector<std::uint8_t>& out, bool columns) {
    const int lines = columns ? w : h, length = columns ? h : w;
    for (int line = 0; line < lines; ++line) {
      const auto index = [&](int k) { return columns ? at(line, k) : at(k, line); };
      int first = -1, last = -1;
      for (int k = 0; k < length; ++k) {
        if (!in[index(k)]) continue;
        if (first < 0) first = k;
        last = k;
      }
      for (int k = first; first >= 0 && k <= last; ++k) out[index(k)] = 1;
    }
  }

  std::size_t samples_of(bool key) const {
    const std::size_t n = data_.frames.size();
    // More say little: noise is smoothed over 25 pixels, so that near samples share theirs.
    return std::clamp<std::size_t>(150000 / n, key ? 400 : 350, n > 24 ? 1500 : 4000);
  }

  Result<> read_all() {
    context_.begin_phase("read frames", data_.frames.size());
    std::vector<std::uint8_t> is_key(data_.frames.size(), 0);
    for (const std::size_t k : data_.keys) is_key[k] = 1;
    std::vector<Result<>> results(data_.frames.size());
    std::vector<std::vector<Vec3f>> clouds(data_.frames.size());
    parallel_for(data_.frames.size(), 1, [&](std::size_t i) {
      if (context_.cancelled()) return;
      results[i] = read_one(data_.frames[i], is_key[i] != 0, clouds[i]);
      context_.advance();
    });
    TURNSCAN_TRY(context_.check());
    for (auto& result : results) TURNSCAN_TRY(result);
    for (const auto& cloud : clouds)
      data_.cloud.insert(data_.cloud.end(), cloud.begin(), cloud.end());
    return {};
  }

  Result<> read_one(MotionFrame& frame, bool key, std::vector<Vec3f>& cloud) const {
    TURNSCAN_ASSIGN(const Frame raw, sequence_.read(frame.position));
    const auto seed = hash_key(kSeed, frame.position);
    if (data_.projective) {
      take_depth(raw, key, seed, frame, cloud);
      return {};
    }
    return take_points(raw, key, seed, frame, cloud);
  }

  void take_depth(const Frame& raw, bool key, std::uint64_t seed, MotionFrame& frame,
                  std::vector<Vec3f>& cloud) const {
    const SensorInfo& sensor = sequence_.header().sensors.front();
    MotionView view;
    view.left = foreground_.left, view.top = foreground_.top;
    view.width = foreground_.right - foreground_.left;
    view.height = foreground_.bottom - foreground_.top;
    view.z.assign(std::size_t(view.width) * std::size_t(view.height), 0.0f);
    if (raw.depth.width != data_.camera.width || raw.depth.height != data_.camera.height) return;
    std::vector<std::int32_t> inside;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const auto pixel = std::size_t(y + view.top) * std::size_t(data_.camera.width) +
                           std::size_t(x + view.left);
        const std::uint16_t value = raw.depth.pixels[pixel];
        if (value == kNoReturn || value == kOutsideCrop) continue;
        const auto z = float(value * sensor.depth_unit_m + sensor.depth_bias_m);
        const Vec3f p(rays_.x()[pixel] * z, rays_.y()[pixel] * z, z);
        if (!(z > 0.0f) || !foreground_.holds(pixel, p)) continue;
        const auto i = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
        view.z[i] = z;
        inside.push_back(std::int32_t(i));
      }
    }
    drop_mixed(view, inside);
    frame.raw = trimmed(view, inside);
    smooth(view, inside);
    sample_depth(view, inside, seed, samples_of(key), frame, cloud);
    if (!key) return;
    unsag(view, inside);
    frame.view = trimmed(view, inside);
  }

  /// What is left of the view without the margins that show nothing.
  static MotionView trimmed(const MotionView& view, const std::vector<std::int32_t>& inside) {
    int left = view.width, top = view.height, right = 0, bottom = 0;
    for (const std::int32_t i : inside) {
      const int x = int(i) % view.width, y = int(i) / view.width;
      left = std::min(left, x), right = std::max(right, x + 1);
      top = std::min(top, y), bottom = std::max(bottom, y + 1);
    }
    MotionView out;
    if (inside.empty()) return out;
    out.left = view.left + left, out.top = view.top + top;
    out.width = right - left, out.height = bottom - top;
    for (int y = top; y < bottom; ++y) {
      const float* row = &view.z[std::size_t(y) * std::size_t(view.width)];
      out.z.insert(out.z.end(), row + left, row + right);
    }
    return out;
  }

  /// Weighted sum of z over 5 x 5 pixels around pixel i, row by row; nullopt where the window is
  /// not whole: at the image's border, or where a pixel lies on another surface.
  std::optional<double> window_sum(const MotionView& view, const std::vector<float>& z,
                                   std::int32_t i, const std::array<int, 25>& weights) const {
    const int w = view.width;
    const int x = int(i) % w, y = int(i) / w;
    if (x < 2 || y < 2 || x + 2 >= w || y + 2 >= view.height) return std::nullopt;
    const float here = z[std::size_t(i)];
    const auto limit = float(4.0 * here / data_.camera.fx + 4.0 * data_.noise_m);
    double sum = 0.0;
    for (int k = 0; k < 25; ++k) {
      const float there = z[std::size_t(i + (k / 5 - 2) * w + k % 5 - 2)];
      if (!(there > 0.0f && std::abs(there - here) < limit)) return std::nullopt;
      sum += weights[std::size_t(k)] * double(there);
    }
    return sum;
  }

  /// Between pixels look_up() follows chords, which lie behind a convex surface: by a twelfth of
  /// the second difference in the mean, in each direction. The pixels move by as much the other
  /// way. Second differences are those of the quadratic surface through 5 x 5 pixels.
  void unsag(MotionView& view, const std::vector<std::int32_t>& inside) const {
    static constexpr std::array<int, 5> kSecond{2, -1, -2, -1, 2};
    std::array<int, 25> weights{};
    for (std::size_t k = 0; k < 25; ++k) weights[k] = kSecond[k % 5] + kSecond[k / 5];
    const std::vector<float> z = view.z;
    for (const std::int32_t i : inside)
      if (const auto sum = window_sum(view, z, i, weights))
        view.z[std::size_t(i)] = float(z[std::size_t(i)] - *sum / (35.0 * 12.0));
  }

  /// Pixels that lie well behind a neighbour may be mixed of two surfaces.
  void drop_mixed(MotionView& view, std::vector<std::int32_t>& inside) const {
    const std::vector<float> z = view.z;
    const int w = view.width;
    std::erase_if(inside, [&](std::int32_t i) {
      const float here = z[std::size_t(i)];
      const auto limit = float(2.0 * here / data_.camera.fx + 3.5 * data_.noise_m);
      const int x = int(i) % w, y = int(i) / w;
      bool mixed = x == 0 || y == 0 || x + 1 == w || y + 1 == view.height;
      for (const int there : {i - w, i - 1, i + 1, i + w}) {
        if (mixed) break;
        const float other = z[std::size_t(there)];
        mixed = other > 0.0f && here - other > limit;
      }
      if (mixed) view.z[std::size_t(i)] = 0.0f;
      return mixed;
    });
  }

  /// Noise moves points sideways in the other frames' views, where every convex surface then seems
  /// to lie deeper. A quadratic surface through 5 x 5 pixels (Savitzky and Golay 1964) takes most
  /// of it away and leaves curvature alone. Where the window is not whole the pixel stays.
  void smooth(MotionView& view, const std::vector<std::int32_t>& inside) const {
    static constexpr std::array<int, 25> kWeights{-13, 2, 7, 2,  -13, 2,  17, 22,  17, 2, 7, 22, 27,
                                                  22,  7, 2, 17, 22,  17, 2,  -13, 2,  7, 2, -13};
    const std::vector<float> z = view.z;
    for (const std::int32_t i : inside)
      if (const auto sum = window_sum(view, z, i, kWeights))
        view.z[std::size_t(i)] = float(*sum / 175.0);
  }

  void sample_depth(const MotionView& view, const std::vector<std::int32_t>& inside,
                    std::uint64_t seed, std::size_t wanted, MotionFrame& frame,
                    std::vector<Vec3f>& cloud) const {
    if (inside.size() < 50) return;
    // One of each stretch of rows, so that all parts have their say; then once more.
    const double stretch = std::max(1.0, double(inside.size()) / double(wanted));
    const std::size_t tries = std::min(2 * wanted, 3 * inside.size());
    for (std::size_t t = 0; t < tries && frame.samples.size() < wanted; ++t) {
      const double place =
          std::fmod((double(t) + uniform01(hash_key(seed, t))) * stretch, double(inside.size()));
      const auto i = std::size_t(inside[std::size_t(place)]);
      const int x = int(i) % view.width, y = int(i) / view.width;
      const double z = view.z[i], spacing = z / data_.camera.fx;
      const auto pixel =
          std::size_t(y + view.top) * std::size_t(data_.camera.width) + std::size_t(x + view.left);
      const Vec3d ray(rays_.x()[pixel], rays_.y()[pixel], 1.0), p = ray * z;
      if (t % 4 == 0) cloud.push_back(p.cast<float>());
      const int reach = std::clamp(int(std::lround(kWindow_m / spacing)), 1, 6);
      const auto normal = normal_at(view.z, view.width, view.height, x, y, reach, data_.camera,
                                    data_.noise_m, spacing);
      if (!normal) continue;
      const Vec3d n = unit_normal(normal->n, ray, p);
      if (-n.dot(p.normalized()) < 0.3) continue;
      frame.samples.push_back({p.cast<float>(), n.cast<float>(), float(normal->sigma)});
    }
  }

  Result<> take_points(const Frame& raw, bool key, std::uint64_t seed, MotionFrame& frame,
                       std::vector<Vec3f>& cloud) const {
    const SensorInfo& sensor = sequence_.header().sensors.front();
    TURNSCAN_ASSIGN(const FramePoints points, points_of(raw, sensor, RayTable()));
    const auto& all = points.cloud.points;
    if (all.size() < 50) return {};
    MotionView view;
    view.points = all;
    view.tree = KdTree(all);
    constexpr std::size_t kNeighbours = 20;
    std::array<std::uint32_t, kNeighbours> index{};
    std::array<float, kNeighbours> squared{};
    const std::size_t wanted = samples_of(key);
    for (std::size_t t = 0; t < 2 * wanted && frame.samples.size() < wanted; ++t) {
      const Vec3f p = all[std::size_t(uniform01(hash_key(seed, t)) * double(all.size()))];
      cloud.push_back(p);
      if (view.tree.knn(p, kNeighbours, index.data(), squared.data()) < kNeighbours) continue;
      Vec3d mean = Vec3d::Zero();
      for (const auto i : index) mean += all[i].cast<double>() / double(kNeighbours);
      Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
      for (const auto i : index) {
        const Vec3d d = all[i].cast<double>() - mean;
        spread += d * d.transpose() / double(kNeighbours);
      }
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
      const Vec3d& e = eigen.eigenvalues();
      if (!(e[1] > 0.0) || e[0] > 0.05 * e[1]) continue;
      Vec3d n = eigen.eigenvectors().col(0);
      if (n.dot(points.viewpoint.direction_from(p.cast<double>())) < 0.0) n = -n;
      frame.samples.push_back(
          {p, n.cast<float>(), float(std::sqrt(std::max(e[0], 0.0) / e[1] / kNeighbours))});
    }
    if (key) frame.view = std::move(view);
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

  /// Spacing and noise of scans of points, from the neighbours of some of them.
  void measure_points() {
    std::vector<double> distances;
    for (const std::size_t k : data_.keys) {
      const MotionView& view = data_.frames[k].view;
      for (std::size_t s = 0; s < data_.frames[k].samples.size(); s += 20) {
        std::array<std::uint32_t, 2> index{};
        std::array<float, 2> squared{};
        if (view.tree.knn(data_.frames[k].samples[s].p, 2, index.data(), squared.data()) == 2)
          distances.push_back(std::sqrt(double(squared[1])));
      }
    }
    data_.spacing_m = median(distances);
    data_.noise_m = std::max(0.1 * data_.spacing_m, 1e-5);
  }

  const FrameSequence& sequence_;
  const MotionDataOptions& options_;
  const RunContext& context_;
  RayTable rays_;
  ScanPixels pixels_;
  Foreground foreground_;
  MotionData data_;
};

}  // namespace

bool Foreground::holds(std::size_t pixel, const Vec3f& p) const {
  if (!plane) return mask[pixel] != 0 && p.z() < farthest_m;
  const Vec3d d = p.cast<double>() - center;
  const double h = plane->normal.dot(d);
  return h > margin_m && h < 3.0 * radius_m + 0.1 &&
         (d - h * plane->normal).squaredNorm() < radius_m * radius_m;
}

bool MotionData::look_up(const MotionView& view, const Vec3d& p, double reach_m,
                         Vec3d& found) const {
  if (!projective) {
    std::uint32_t index = 0;
    float squared = 0.0f;
    if (view.tree.knn(p.cast<float>(), 1, &index, &squared) == 0) return false;
    if (squared > reach_m * reach_m) return false;
    found = view.points[index].cast<double>();
    return true;
  }
  if (!(p.z() > 0.0)) return false;
  Eigen::Vector2d uv;
  if (camera.distorted()) {
    uv = camera.project(p);
  } else {
    uv = {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
  }
  const double fx = uv.x() - view.left, fy = uv.y() - view.top;
  if (!(fx >= 0.0 && fy >= 0.0 && fx < view.width - 1 && fy < view.height - 1)) return false;
  const int x = int(fx), y = int(fy);
  const float* row = &view.z[std::size_t(y) * std::size_t(view.width) + std::size_t(x)];
  const float a = row[0], b = row[1], c = row[view.width], d = row[view.width + 1];
  const float low = std::min(std::min(a, b), std::min(c, d)),
              high = std::max(std::max(a, b), std::max(c, d));
  if (!(low > 0.0f) || high - low > 3.0 * spacing_m + 5.0 * noise_m) return false;
  const double u = fx - x, v = fy - y;
  const double z = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
  if (std::abs(z - p.z()) > reach_m) return false;
  found = p * (z / p.z());
  return true;
}

Result<MotionData> load_motion(const FrameSequence& sequence, const MotionDataOptions& options,
                               const RunContext& context) {
  return Loader(sequence, options, context).run();
}

}  // namespace turnscan::detail
