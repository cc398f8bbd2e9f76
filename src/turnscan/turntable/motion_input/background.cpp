#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion_input/background.hpp>
#include <turnscan/turntable/motion_input/depth_steps.hpp>
#include <turnscan/turntable/motion_input/static_background.hpp>

namespace turnscan::motion {

namespace {

/// Flickering patches, where a mixed pixel jumps between two static surfaces, are smaller than the
/// moving object.
constexpr double kMinShareOfLargest = 0.15;
constexpr std::size_t kMinMovingPixels = 100;
/// Ratio between the inter-decile range of a pixel's depths and the noise above which it moves; 2.6
/// for normal noise.
constexpr double kMovingSigmas = 4.0;
constexpr double kMinMove_m = 0.003;
/// In depth steps of the sensor: static depth may fall to either side of a step.
constexpr double kMovingSteps = 2.5;
/// A pixel shows two surfaces if no depth is between them, in ranges of static depth.
constexpr double kClearGap = 3.0;
/// Surface that is seen now and then at one depth is static if that holds for a wide patch: on a
/// turning object only lines along its outline have this property. A share of all moving pixels.
constexpr double kMinPassing = 0.02;

/// The depths of every pixel over all frames; 0: none.
class DepthStack {
 public:
  static Result<DepthStack> read(const FrameSequence& sequence,
                                 const std::vector<std::size_t>& positions,
                                 const RunContext& context) {
    DepthStack out;
    const SensorInfo& sensor = sequence.header().sensors.front();
    out.width_ = sensor.intrinsics.width, out.height_ = sensor.intrinsics.height;
    out.images_.assign(positions.size(), {});
    out.depth_unit_m_ = sensor.depth_unit_m;
    const auto keep = [&](std::size_t k, const Frame& frame) -> Result<> {
      out.images_[k] = out.depths_of(frame.depth, sensor);
      return {};
    };
    TURNSCAN_TRY(read_frames(sequence, positions, context, keep));
    return out;
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t frames() const { return images_.size(); }
  const std::vector<float>& image(std::size_t k) const { return images_[k]; }
  DepthSteps steps() const { return DepthSteps(images_, depth_unit_m_); }

  /// A pixel's depths, ascending.
  void depths(std::size_t pixel, std::vector<float>& out) const {
    out.clear();
    for (const auto& image : images_)
      if (image[pixel] > 0.0f) out.push_back(image[pixel]);
    std::sort(out.begin(), out.end());
  }

 private:
  std::vector<float> depths_of(const DepthImage& depth, const SensorInfo& sensor) const {
    std::vector<float> out(std::size_t(width_) * std::size_t(height_), 0.0f);
    if (depth.pixels.size() != out.size()) return out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint16_t value = depth.pixels[i];
      if (value != kNoReturn && value != kOutsideCrop)
        out[i] = float(value * sensor.depth_unit_m + sensor.depth_bias_m);
    }
    return out;
  }

  int width_ = 0, height_ = 0;
  std::vector<std::vector<float>> images_;
  double depth_unit_m_ = 0.001;
};

/// Second difference of a row over every second pixel, since neighbours share some of their noise;
/// NaN if it is not available.
float second_difference(const std::vector<float>& z, std::size_t i, std::size_t width) {
  const std::size_t x = i % width;
  if (x < 2 || x + 2 >= width) return std::numeric_limits<float>::quiet_NaN();
  if (!(z[i - 2] > 0.0f && z[i] > 0.0f && z[i + 2] > 0.0f))
    return std::numeric_limits<float>::quiet_NaN();
  return std::abs(z[i - 2] - 2.0f * z[i] + z[i + 2]);
}

/// Third difference over every step-th pixel from i on, which is insensitive to curvature, scaled
/// as a second difference of the same noise; NaN if it is not available.
float third_difference(const std::vector<float>& z, std::size_t i, std::size_t width,
                       std::size_t step) {
  if (i % width + 3 * step >= width) return std::numeric_limits<float>::quiet_NaN();
  const float a = z[i], b = z[i + step], c = z[i + 2 * step], d = z[i + 3 * step];
  if (!(a > 0.0f && b > 0.0f && c > 0.0f && d > 0.0f))
    return std::numeric_limits<float>::quiet_NaN();
  constexpr float kToSecond = 0.5477226f;  // sqrt(6 / 20)
  return kToSecond * (a - 3.0f * b + 3.0f * c - d);
}

/// Standard deviation of a depth value from magnitudes of second differences. On edges and bends
/// these are larger; most are on neither.
double noise_from(std::vector<float> differences) {
  return estimation::mad_sigma(differences) / std::sqrt(6.0);
}

/// Distance of the rows that determine the smoothness of a place: these share no noise with it.
constexpr std::size_t kRowsBeside = 3;
/// Share of the places, those on the smoothest surface, that is used.
constexpr double kSmoothest = 0.35;

/// A place in an image: third differences there over every pixel and every second one, and the
/// curvature of the adjacent surface.
struct NoisePlace {
  float near, far, bent;
};

std::optional<NoisePlace> noise_place(const std::vector<float>& z, std::size_t i,
                                      std::size_t width) {
  const std::size_t rows = kRowsBeside * width;
  if (i < rows || i + rows >= z.size()) return std::nullopt;
  const NoisePlace out{
      third_difference(z, i, width, 1), third_difference(z, i, width, 2),
      third_difference(z, i - rows, width, 2) + third_difference(z, i + rows, width, 2)};
  if (!std::isfinite(out.near + out.far + out.bent)) return std::nullopt;
  return NoisePlace{std::abs(out.near), std::abs(out.far), std::abs(out.bent)};
}

/// Uses a subset of frames and pixels; mask: per pixel, 0 excludes it; empty: all. Features of an
/// object look like noise between pixels, so only the smoothest places are used, as judged by their
/// neighbours, whose noise is independent.
SpatialNoise noise_of(const DepthStack& stack, std::size_t every_frame, std::size_t every_pixel,
                      const std::vector<std::uint8_t>& mask) {
  std::vector<NoisePlace> places;
  const auto width = std::size_t(stack.width());
  for (std::size_t k = 0; k < stack.frames(); k += every_frame) {
    const auto& image = stack.image(k);
    for (std::size_t i = 0; i < image.size(); i += every_pixel) {
      if (!mask.empty() && mask[i] == 0) continue;
      if (const auto place = noise_place(image, i, width)) places.push_back(*place);
    }
  }
  if (places.empty()) return {};
  const auto smooth = std::size_t(kSmoothest * double(places.size()));
  std::nth_element(places.begin(), places.begin() + std::ptrdiff_t(smooth), places.end(),
                   [](const NoisePlace& a, const NoisePlace& b) { return a.bent < b.bent; });
  places.resize(std::max<std::size_t>(smooth, 1));
  std::vector<float> near, far;
  for (const NoisePlace& place : places) near.push_back(place.near), far.push_back(place.far);
  return {noise_from(std::move(far)), noise_from(std::move(near))};
}

class BackgroundSearch {
 public:
  BackgroundSearch(const DepthStack& stack, double noise_m)
      : stack_(stack),
        steps_(stack.steps()),
        w_(stack.width()),
        h_(stack.height()),
        noise_m_(noise_m) {}

  Result<Background> run() {
    find_moving();
    keep_large_patches();
    const auto moving = std::size_t(std::count(moving_.begin(), moving_.end(), 1));
    if (moving < kMinMovingPixels)
      return fail(ErrorCode::kTooFewPoints,
                  "motion: nothing turns in the recording, or nothing that can be seen to turn");
    Background out{w_, h_, std::vector<float>(moving_.size(), 0.0f), noise_m_};
    if (const double within = noise_of(stack_, 4, 3, moving_).sigma_m; within > 0.0)
      out.noise_m = within;
    set_limits(out.nearer_than);
    return out;
  }

 private:
  /// Range of a pixel's depth without motion. Noise is larger far away and at grazing incidence, as
  /// is then the difference between neighbours.
  double still_range(std::size_t pixel, double depth_m) const {
    thread_local std::vector<float> differences;
    differences.clear();
    for (std::size_t k = 0; k < stack_.frames(); ++k) {
      const float size = second_difference(stack_.image(k), pixel, std::size_t(w_));
      if (std::isfinite(size)) differences.push_back(size);
    }
    const double noise = differences.size() < 4 ? noise_m_ : noise_from(differences);
    const double steps = kMovingSteps * steps_.at(depth_m);
    return std::max({kMovingSigmas * std::max(noise, noise_m_), steps, kMinMove_m});
  }

  void find_moving() {
    const std::size_t n = moving_.size();
    parallel_for(n, 4096, [&](std::size_t i) {
      thread_local std::vector<float> depths;
      stack_.depths(i, depths);
      judge(i, depths);
    });
  }

  void judge(std::size_t i, const std::vector<float>& depths) {
    const std::size_t frames = stack_.frames(), valid = depths.size();
    if (valid == 0) return;
    const std::size_t tenth = valid / 10;
    const double range = double(depths[valid - 1 - tenth] - depths[tenth]);
    const double still = still_range(i, double(depths[valid - 1]));
    const bool comes_and_goes = 10 * valid < 9 * frames && 10 * valid > frames;
    if (range <= still && !comes_and_goes) {
      if (2 * valid >= frames) still_.seen[i] = depths[valid / 2];
      return;
    }
    moving_[i] = 1;
    still_.tolerance[i] = float(still);
    if (valid >= 4 && range <= still) passing_[i] = depths[valid / 2];
    farthest_[i] = depths[valid - 1];
    // The farthest depth may be static if it is seen again; else the object occludes the
    // background.
    if (valid < 4 || double(depths[valid - 1] - depths[valid - 3]) >= still) return;
    const float far = depths[valid - 2];
    still_.candidate[i] = far;
    const auto nearer = std::lower_bound(depths.begin(), depths.end(), far - float(still));
    apart_[i] = nearer != depths.begin() && double(far - *(nearer - 1)) > kClearGap * still ? 1 : 0;
  }

  /// Where the object always occludes a pixel, its own farthest depth is also seen again. Cutting
  /// it off would keep only the part whose noise makes it nearer, and tilt the axis. Where there
  /// are static surroundings, however, it may be one of them: a platter that was not detected, or a
  /// step of a desk.
  void set_limits(std::vector<float>& nearer_than) {
    for (std::size_t i = 0; i < moving_.size(); ++i)
      if (moving_[i] == 0) still_.candidate[i] = 0.0f;
    const bool passes = see_what_passes();
    const auto continued = continued_from_seen(still_);
    const bool room = passes || std::count(continued.begin(), continued.end(), 1) > 0;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      if (moving_[i] == 0) continue;
      const bool known = continued[i] != 0 || (still_.candidate[i] > 0.0f && lone_[i] == 0);
      const double gaps = apart_[i] != 0 && continued[i] == 0 ? 0.5 * kClearGap : 1.0;
      nearer_than[i] = room && known ? still_.candidate[i] - float(gaps) * still_.tolerance[i]
                                     : std::numeric_limits<float>::infinity();
    }
  }

  /// If the images show changing parts of the static surroundings, hardly a pixel shows them most
  /// of the time; they are recognised where wide patches show one depth whenever they show any.
  /// What continues them may then be seen only once. Returns whether this is the case.
  bool see_what_passes() {
    std::vector<std::uint8_t> passing(moving_.size(), 0);
    for (std::size_t i = 0; i < passing.size(); ++i)
      passing[i] = moving_[i] != 0 && passing_[i] > 0.0f ? 1 : 0;
    const std::vector<std::uint8_t> core = eroded(passing);
    std::vector<std::int32_t> label(core.size(), 0);
    std::size_t widest = 0;
    for (std::size_t i = 0; i < core.size(); ++i)
      if (core[i] != 0 && label[i] == 0) widest = std::max(widest, fill(core, label, i, 1));
    const auto moving = double(std::count(moving_.begin(), moving_.end(), 1));
    if (widest < kMinMovingPixels || double(widest) < kMinPassing * moving) return false;
    const auto wide = dilated(core);
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      if (moving_[i] == 0) continue;
      if (passing[i] != 0 && wide[i] != 0) {
        moving_[i] = 0, still_.seen[i] = passing_[i], still_.candidate[i] = 0.0f;
      } else if (still_.candidate[i] == 0.0f) {
        lone_[i] = 1, still_.candidate[i] = farthest_[i];
      }
    }
    still_.least_patch = kMinPassing;
    return true;
  }

  /// Keeps patches of moving pixels without lines one or two pixels wide (opening).
  void keep_large_patches() {
    std::vector<std::uint8_t> core = eroded(moving_);
    std::vector<std::int32_t> label(core.size(), 0);
    std::vector<std::size_t> sizes{0};
    for (std::size_t i = 0; i < core.size(); ++i) {
      if (core[i] == 0 || label[i] != 0) continue;
      sizes.push_back(fill(core, label, i, std::int32_t(sizes.size())));
    }
    const std::size_t largest = *std::max_element(sizes.begin(), sizes.end());
    for (std::size_t i = 0; i < core.size(); ++i)
      core[i] = core[i] != 0 &&
                double(sizes[std::size_t(label[i])]) >= kMinShareOfLargest * double(largest);
    const auto wide = dilated(dilated(core));
    for (std::size_t i = 0; i < core.size(); ++i) moving_[i] = moving_[i] != 0 && wide[i] != 0;
  }

  template <class Use>
  void around(std::size_t i, const Use& use) const {
    const int x = int(i) % w_, y = int(i) / w_;
    for (int v = std::max(0, y - 1); v <= std::min(h_ - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(w_ - 1, x + 1); ++u)
        use(std::size_t(v) * std::size_t(w_) + std::size_t(u));
  }

  std::vector<std::uint8_t> eroded(const std::vector<std::uint8_t>& in) const {
    std::vector<std::uint8_t> out(in);
    for (std::size_t i = 0; i < in.size(); ++i)
      if (in[i] == 0) around(i, [&](std::size_t k) { out[k] = 0; });
    return out;
  }
  std::vector<std::uint8_t> dilated(const std::vector<std::uint8_t>& in) const {
    std::vector<std::uint8_t> out(in);
    for (std::size_t i = 0; i < in.size(); ++i)
      if (in[i] != 0) around(i, [&](std::size_t k) { out[k] = 1; });
    return out;
  }

  /// Labels the patch of a pixel; returns its size.
  std::size_t fill(const std::vector<std::uint8_t>& in, std::vector<std::int32_t>& label,
                   std::size_t start, std::int32_t name) const {
    std::vector<std::size_t> open{start};
    label[start] = name;
    std::size_t size = 0;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      ++size;
      around(i, [&](std::size_t k) {
        if (in[k] == 0 || label[k] != 0) return;
        label[k] = name;
        open.push_back(k);
      });
    }
    return size;
  }

  const DepthStack& stack_;
  const DepthSteps steps_;
  int w_, h_;
  double noise_m_;
  std::vector<std::uint8_t> moving_ =
      std::vector<std::uint8_t>(std::size_t(w_) * std::size_t(h_), 0);
  std::vector<std::uint8_t> lone_ = moving_;   ///< the candidate was not seen again
  std::vector<std::uint8_t> apart_ = moving_;  ///< no depth just before the candidate
  std::vector<float> passing_ = std::vector<float>(moving_.size(), 0.0f);  ///< seen now and then
  std::vector<float> farthest_ = passing_;
  StaticBackground still_{w_, h_, std::vector<float>(moving_.size(), 0.0f),
                          std::vector<float>(moving_.size(), 0.0f),
                          std::vector<float>(moving_.size(), 0.0f)};
};

}  // namespace

Result<SpatialNoise> spatial_noise(const FrameSequence& sequence,
                                   const std::vector<std::size_t>& positions,
                                   const RunContext& context) {
  TURNSCAN_ASSIGN(const DepthStack stack, DepthStack::read(sequence, positions, context));
  return noise_of(stack, 1, 3, {});
}

Result<Background> find_background(const FrameSequence& sequence,
                                   const std::vector<std::size_t>& positions, double noise_m,
                                   const RunContext& context) {
  TURNSCAN_ASSIGN(const DepthStack stack, DepthStack::read(sequence, positions, context));
  return BackgroundSearch(stack, noise_m).run();
}

}  // namespace turnscan::motion
