#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/simulator/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr double kRight = std::numbers::pi / 2;
constexpr int kSide = 4;           // rays across a mixed pixel
constexpr double kSteepest = 4.0;  // slope, along which depth is carried at most
constexpr int kMostRadius = 8;     // pixels about a step that its lateral noise reaches

// Purposes of random numbers.
constexpr std::uint64_t kAxial = 1, kDisparity = 2, kDark = 3, kDrop = 4, kAcross = 5, kAlong = 6;

/// What a pixel sees, mixed or not.
struct Seen {
  double z = 0.0;
  double facing = 1.0;  ///< cosine of the incidence
  double signal = 0.0;  ///< albedo * facing / z^2
};

class Formulae {
 public:
  explicit Formulae(Job& job)
      : job_(job),
        noise_(job.setup.model.noise),
        surfaces_(job.view),
        counts_(job.exact.size()),
        drop_seed_(job.seed_of(kDrop)) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] = job.exact.counts(i) ? 1 : 0;
  }

  void run() {
    radius_ = radius();
    const Mask mixed = mixes() ? steps_of(job_.exact, counts_, radius_) : Mask();
    const PixelRect& r = job_.exact.rect;
    for (int v = r.top; v < r.bottom; ++v) {
      draw_row(v);
      for (int u = r.left; u < r.right; ++u) {
        const std::size_t i = job_.exact.index(u, v);
        if (!mixed.empty() && mixed[i] != 0)
          add_mixed(u, v, i);
        else if (counts_[i] != 0)
          measure(i, job_.setup.pixel(u, v), u - r.left, seen_alone(u, v, i));
      }
    }
    if (!rays_.index.empty()) measure_mixed();
  }

 private:
  double lateral(double z) const {
    return lateral_sigma_px(noise_, job_.setup.model.camera.fx, z, 0.0);
  }
  bool mixes() const { return noise_.footprint_px > 0.0 || lateral(1.0) > 0.0; }

  /// Out to three sigma of the nearest thing.
  int radius() const {
    float nearest = 1e9f;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (counts_[i] != 0) nearest = std::min(nearest, job_.exact.z[i]);
    const double reach = 0.5 * noise_.footprint_px + 3.0 * lateral(nearest) - 0.5;
    return static_cast<int>(std::clamp(std::ceil(reach), 0.0, double(kMostRadius)));
  }

  std::size_t pixel_of(std::size_t i) const {
    const PixelRect& r = job_.exact.rect;
    const auto w = static_cast<std::size_t>(r.width());
    return job_.setup.pixel(r.left + int(i % w), r.top + int(i / w));
  }

  /// Standard normals of a row, of each purpose that is wanted.
  void draw_row(int v) {
    const PixelRect& r = job_.exact.rect;
    const auto n = static_cast<std::size_t>(r.width());
    const auto first = static_cast<std::uint32_t>(job_.setup.pixel(r.left, v));
    const auto draw = [&](std::uint64_t purpose, bool wanted) {
      auto& row = normals_[purpose];
      row.resize(n, 0.0f);
      if (wanted) kernel().normals(job_.key_of(purpose), first, 1, int(n), row.data());
    };
    draw(kAxial, true);
    draw(kDisparity, noise_.disparity_sigma_px > 0.0);
    draw(kDark, noise_.dark_jitter > 0.0 && noise_.dark_signal_per_m2 > 0.0);
  }

  /// The same numbers for a pixel by itself.
  double normal_of(std::uint64_t purpose, std::size_t pixel) const {
    float out = 0.0f;
    kernel().normals(job_.key_of(purpose), static_cast<std::uint32_t>(pixel), 1, 1, &out);
    return out;
  }

  Seen seen(const Samples& samples, std::size_t i, double x, double y) const {
    Seen s;
    s.z = samples.z[i];
    s.facing = surfaces_.facing(samples, i, x, y);
    s.signal = surfaces_.albedo(samples, i) * s.facing / (s.z * s.z);
    return s;
  }

  /// A ray within a pixel, its depth carried along the surface to the line of sight through the
  /// pixel's centre: lateral noise decides which surface is seen; what it does on a slope is part
  /// of the axial formula.
  Seen seen_in_line(std::size_t k, std::size_t pixel) const {
    Seen s = seen(rays_.samples, k, rays_.x[k], rays_.y[k]);
    const double x = job_.setup.rays.x()[pixel], y = job_.setup.rays.y()[pixel];
    const double there = s.facing * std::hypot(rays_.x[k], rays_.y[k], 1.0);
    const double here = surfaces_.facing(rays_.samples, k, x, y) * std::hypot(x, y, 1.0);
    const double most = kSteepest * s.z * std::hypot(rays_.x[k] - x, rays_.y[k] - y);
    s.z += std::clamp(s.z * (there / std::max(here, 1e-9) - 1.0), -most, most);
    return s;
  }

  Seen seen_alone(int u, int v, std::size_t i) const {
    const std::size_t pixel = job_.setup.pixel(u, v);
    return seen(job_.exact, i, job_.setup.rays.x()[pixel], job_.setup.rays.y()[pixel]);
  }

  void add_mixed(int u, int v, std::size_t i) {
    const std::size_t pixel = job_.setup.pixel(u, v);
    const double z = job_.exact.hit(i) ? double(job_.exact.z[i]) : nearest_around(u, v);
    if (!(z > 0.0)) return;
    const double facing = counts_[i] != 0 ? seen_alone(u, v, i).facing : 1.0;
    // The formula's steep end would throw the ray anywhere.
    const double sigma =
        std::min(lateral_sigma_px(noise_, job_.setup.model.camera.fx, z, std::acos(facing)),
                 2.0 * lateral(z));
    rays_.add(job_.setup, u, v, i, noise_.footprint_px > 0.0 ? kSide : 1, noise_.footprint_px,
              sigma * normal_of(kAcross, pixel), sigma * normal_of(kAlong, pixel));
  }

  /// Of what lies within reach of the noise.
  double nearest_around(int u, int v) const {
    double nearest = 0.0;
    for (int y = v - radius_ - 1; y <= v + radius_ + 1; ++y) {
      for (int x = u - radius_ - 1; x <= u + radius_ + 1; ++x) {
        if (!job_.exact.contains(x, y)) continue;
        const std::size_t k = job_.exact.index(x, y);
        if (counts_[k] != 0 && (nearest == 0.0 || job_.exact.z[k] < nearest))
          nearest = job_.exact.z[k];
      }
    }
    return nearest;
  }

  void measure_mixed() {
    job_.view.tracer.trace(job_.view.bodies, job_.view.T_world_sensor, rays_.x, rays_.y,
                           rays_.samples);
    for (std::size_t p = 0; p < rays_.index.size(); ++p) {
      const std::size_t i = rays_.index[p], pixel = pixel_of(i);
      for (const std::uint64_t purpose : {kAxial, kDisparity, kDark})
        normals_[purpose].assign(1, float(normal_of(purpose, pixel)));
      measure(i, pixel, 0, mixed(p, i));
    }
  }

  /// The mean of all that returns, each weighed by its light; z = 0 when nothing does or the sensor
  /// sees through it.
  Seen mixed(std::size_t p, std::size_t i) {
    double light = 0.0, z = 0.0, facing = 0.0, nearest = 1e9, farthest = 0.0;
    Miss miss = rays_.samples.miss[p * rays_.each];
    for (std::size_t k = p * rays_.each; k < (p + 1) * rays_.each; ++k) {
      if (!rays_.samples.counts(k)) continue;
      const Seen s = seen_in_line(k, pixel_of(i));
      light += s.signal;
      z += s.signal * s.z;
      facing += s.signal * s.facing;
      nearest = std::min(nearest, s.z);
      farthest = std::max(farthest, s.z);
      miss = Miss::kNone;
    }
    job_.out.miss[i] = miss;
    if (!(light > 0.0)) return {};
    const Seen mean{z / light, std::min(facing / light, 1.0), light / double(rays_.each)};
    const double reject = noise_.mixed_rejection_m;
    if (reject > 0.0 && mean.z - nearest > reject && farthest - mean.z > reject) {
      job_.out.miss[i] = Miss::kRejected;
      return {};
    }
    return mean;
  }

  void lose(std::size_t i, Miss miss) {
    job_.out.z[i] = 0.0f;
    job_.out.miss[i] = miss;
  }

  bool dropped(double incidence, std::size_t pixel) const {
    if (incidence <= noise_.drop_from_rad || noise_.drop_from_rad >= kRight) return false;
    if (incidence >= noise_.drop_to_rad) return true;
    const double chance =
        (incidence - noise_.drop_from_rad) / (noise_.drop_to_rad - noise_.drop_from_rad);
    return uniform01(mix64(drop_seed_ ^ pixel)) < chance;
  }

  /// `at`: place of its normals in their rows.
  void measure(std::size_t i, std::size_t pixel, int at, const Seen& s) {
    if (!(s.z > 0.0)) {
      if (job_.out.miss[i] == Miss::kNone) job_.out.miss[i] = Miss::kTooDark;
      return;
    }
    const auto k = static_cast<std::size_t>(at);
    const double incidence = std::acos(s.facing);
    if (dropped(incidence, pixel)) return lose(i, Miss::kGrazing);
    if (s.signal * (1.0 + noise_.dark_jitter * normals_[kDark][k]) < noise_.dark_signal_per_m2)
      return lose(i, Miss::kTooDark);
    const double z = distorted(s, incidence, k);
    if (!(z > 0.0) || !std::isfinite(z)) return lose(i, Miss::kRejected);
    job_.out.z[i] = static_cast<float>(z);
    job_.out.miss[i] = Miss::kNone;
  }

  double distorted(const Seen& s, double incidence, std::size_t k) const {
    const double fb = job_.setup.focal_baseline, z = s.z;
    const double albedo = s.signal * z * z / std::max(s.facing, 1e-6);
    double sigma = noise_.physics == SensorPhysics::kLaserLine && noise_.line_width_m > 0.0
                       ? turnscan::predicted_sigma_m(noise_, fb, z, incidence, albedo)
                       : axial_sigma_m(noise_, z, incidence);
    if (!std::isfinite(sigma)) return 0.0;
    // The steps have their share of the measured sigma already.
    const double step = disparity_step_m(noise_, fb, z);
    sigma = std::sqrt(std::max(sigma * sigma - step * step / 12.0, 0.0));
    double noisy = z + sigma * normals_[kAxial][k];
    if (fb > 0.0 && noise_.disparity_sigma_px > 0.0)
      noisy = fb / (fb / noisy + noise_.disparity_sigma_px * normals_[kDisparity][k]);
    return quantised_depth_m(noise_, fb, noisy) + noise_.bias_m;
  }

  Job& job_;
  const NoiseModel& noise_;
  Surfaces surfaces_;
  Mask counts_;
  std::uint64_t drop_seed_;
  int radius_ = 0;                             ///< pixels about a step that are looked into
  std::array<std::vector<float>, 4> normals_;  ///< by purpose
  SubSamples rays_;
};

}  // namespace

void apply_formulae(Job& job) { Formulae(job).run(); }

}  // namespace turnscan::noise
