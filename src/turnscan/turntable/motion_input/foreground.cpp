#include <algorithm>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/motion_input/background.hpp>
#include <turnscan/turntable/motion_input/foreground.hpp>

namespace turnscan::motion {

namespace {

constexpr std::size_t kMeanFrames = 36;  ///< averaged by the search
/// Ratio of temporal to spatial noise from which nothing is static.
constexpr double kMovingNoise = 3.0;

/// Share of the moving pixels that is on its platter.
constexpr double kCarried = 0.8;
constexpr int kRimPixels = 2;

/// Radius assumed for a platter of which only the axis is known.
constexpr double kUnknownRadius_m = 0.3;

class ForegroundSearch {
 public:
  ForegroundSearch(const FrameSequence& sequence, const MotionDataOptions& options,
                   MotionData& data, const RunContext& context)
      : sequence_(sequence), options_(options), data_(data), context_(context) {}

  Result<Foreground> run() {
    AverageOptions average;
    average.min_share = 0.3;
    std::vector<std::size_t> positions;
    for (const std::size_t i : evenly_spread(data_.frames.size(), kMeanFrames))
      positions.push_back(data_.frames[i].position);
    TURNSCAN_ASSIGN(const AveragedScan scan,
                    average_frames(sequence_, positions, average, context_));
    TURNSCAN_ASSIGN(const bool still, find_noise(scan, positions));
    if (options_.use_platter) TURNSCAN_TRY(find_platter(scan, still));
    if (const auto& platter = data_.platter) {
      crop_to(platter->axis, platter->center_m, platter->radius_m, platter->plane_rms_m);
    } else if (options_.hint && options_.hint->radius_m) {
      crop_to_hint(*options_.hint->radius_m);
    } else {
      TURNSCAN_TRY(tell_by_motion(positions));
    }
    return std::move(foreground_);
  }

 private:
  /// still: most of the scene is static. Otherwise the platter is searched for among static pixels
  /// and must carry the moving ones: a turning object may have a round top.
  Result<> find_platter(const AveragedScan& scan, bool still) {
    PlatterMemory* memory = options_.memory;
    if (memory != nullptr && memory->searched) {
      data_.platter = memory->platter;
      return {};
    }
    const auto platter =
        detect_platter(still ? scan : without_moving(scan), options_.detect, context_);
    if (!platter && platter.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(platter.error());
    if (platter && (still || carries_moving(scan, *platter))) data_.platter = *platter;
    if (memory != nullptr) *memory = {true, data_.platter};
    return {};
  }

  bool moves(const AveragedScan& scan, std::size_t pixel) const {
    return scan.depth_m.pixels[pixel] > 0.0f &&
           !(double(scan.noise_m.pixels[pixel]) < kMovingNoise * data_.noise_m);
  }

  /// Pixels beside static ones are kept, since those of a rim flicker.
  AveragedScan without_moving(AveragedScan scan) const {
    const int w = scan.depth_m.width, h = scan.depth_m.height;
    Image<std::uint8_t> near_still(w, h, 0);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const std::size_t i = std::size_t(y) * std::size_t(w) + std::size_t(x);
        if (!(scan.depth_m.pixels[i] > 0.0f) || moves(scan, i)) continue;
        for (int v = std::max(0, y - kRimPixels); v <= std::min(h - 1, y + kRimPixels); ++v)
          for (int u = std::max(0, x - kRimPixels); u <= std::min(w - 1, x + kRimPixels); ++u)
            near_still.at(u, v) = 1;
      }
    for (std::size_t i = 0; i < scan.depth_m.pixels.size(); ++i)
      if (near_still.pixels[i] == 0) scan.depth_m.pixels[i] = 0.0f;
    return scan;
  }

  bool carries_moving(const AveragedScan& scan, const DetectedPlatter& platter) const {
    const RayTable rays(scan.intrinsics);
    double all = 0.0, above = 0.0;
    for (std::size_t i = 0; i < scan.depth_m.pixels.size(); ++i) {
      if (!moves(scan, i)) continue;
      const double z = scan.depth_m.pixels[i];
      const Vec3d p(rays.x()[i] * z, rays.y()[i] * z, z);
      all += 1.0;
      above += platter.axis.dot(p - platter.center_m) > 0.0 ? 1.0 : 0.0;
    }
    return above > kCarried * all;
  }

  /// Sets the noise. Returns whether something is static, possibly a platter: otherwise the pixels
  /// change by more than noise all over the image.
  Result<bool> find_noise(const AveragedScan& scan, const std::vector<std::size_t>& positions) {
    const std::vector<std::size_t> some(
        positions.begin(),
        positions.begin() + std::ptrdiff_t(std::min<std::size_t>(4, positions.size())));
    TURNSCAN_ASSIGN(const SpatialNoise near, spatial_noise(sequence_, some, context_));
    data_.correlated_noise = near.correlated();
    // A sensor that rounds, or smooths strongly, shows none between pixels.
    const double least = sequence_.header().sensors[0].depth_unit_m * 0.3;
    const double spatial = std::max(near.sigma_m, least), temporal = scan.typical_noise_m();
    const bool still = near.sigma_m < least || temporal < kMovingNoise * spatial;
    data_.noise_m = std::max(still ? temporal : spatial, least);
    return still;
  }

  void crop_to(const Vec3d& axis, const Vec3d& center, double radius, double spread) {
    foreground_.plane = detection::Plane{axis, axis.dot(center)};
    foreground_.center = center;
    foreground_.radius_m = radius;
    foreground_.margin_m = std::max({0.003, 4.0 * data_.noise_m, std::min(4.0 * spread, 0.01)});
    foreground_.left = foreground_.top = 0;
    foreground_.right = data_.camera.width;
    foreground_.bottom = data_.camera.height;
    // The cylinder above the platter, half again as high as its diameter, in the image.
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

  void crop_to_hint(double radius_m) {
    crop_to(options_.hint->axis.normalized(), options_.hint->center_m, radius_m, 0.002);
  }

  /// Objects around may stand nearer to the axis than the radius of an unknown platter.
  Result<> tell_by_motion(const std::vector<std::size_t>& positions) {
    const auto found = find_moving(positions);
    if (found || found.error().code == ErrorCode::kCancelled || !options_.hint) {
      data_.notes.push_back(
          "no platter was seen: the object was separated from the background by its motion");
      return found;
    }
    foreground_ = Foreground();
    crop_to_hint(kUnknownRadius_m);
    return {};
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

  Result<> find_moving(const std::vector<std::size_t>& positions) {
    TURNSCAN_ASSIGN(Background background,
                    find_background(sequence_, positions, data_.noise_m, context_));
    data_.noise_m = std::max(background.noise_m, sequence_.header().sensors[0].depth_unit_m * 0.3);
    const int w = background.width, h = background.height;
    foreground_.nearer_than = std::move(background.nearer_than);
    foreground_.left = w, foreground_.top = h;
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        if (!(foreground_.nearer_than[std::size_t(y) * std::size_t(w) + std::size_t(x)] > 0.0f))
          continue;
        foreground_.left = std::min(foreground_.left, x);
        foreground_.right = std::max(foreground_.right, x + 1);
        foreground_.top = std::min(foreground_.top, y);
        foreground_.bottom = std::max(foreground_.bottom, y + 1);
      }
    }
    return {};
  }

  const FrameSequence& sequence_;
  const MotionDataOptions& options_;
  MotionData& data_;
  const RunContext& context_;
  Foreground foreground_;
};

}  // namespace

bool Foreground::contains(std::size_t pixel, const Vec3f& p) const {
  if (!plane) return p.z() < nearer_than[pixel];
  const double h = plane->normal.dot(p.cast<double>() - center);
  return h > margin_m && h < 3.0 * radius_m + 0.1 && !beside(p);
}

bool Foreground::beside(const Vec3f& p) const {
  const Vec3d d = p.cast<double>() - center;
  return (d - plane->normal.dot(d) * plane->normal).squaredNorm() >= radius_m * radius_m;
}

Result<Foreground> find_foreground(const FrameSequence& sequence, const MotionDataOptions& options,
                                   MotionData& data, const RunContext& context) {
  return ForegroundSearch(sequence, options, data, context).run();
}

}  // namespace turnscan::motion
