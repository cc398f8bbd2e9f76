#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr double kSteepestSlope = 4.0;  // maximum slope along which depth is extrapolated
constexpr int kMaxRadius = 8;           // pixels around a step within reach of its lateral noise

/// The surface that a pixel sees, mixed or not.
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
    Mask reached;
    if (mixes()) {
      steps_ = steps_of(job_.exact, counts_, 0);
      reached = steps_of(job_.exact, counts_, radius_);
    }
    if (job_.setup.options.window_px > 1 && matches_patterns(job_.setup.model))
      for (const std::uint64_t purpose : {kAxial, kDisparity})
        alike_[purpose] = window_normals(job_, purpose);
    const PixelRect& r = job_.exact.rect;
    for (int v = r.top; v < r.bottom; ++v) {
      draw_row(v);
      for (int u = r.left; u < r.right; ++u) {
        const std::size_t i = job_.exact.index(u, v);
        if (!reached.empty() && reached[i] != 0)
          look_aside(u, v, i);
        else if (counts_[i] != 0)
          measure(i, job_.setup.pixel(u, v), u - r.left, seen_alone(u, v, i));
      }
    }
    if (!rays_.index.empty()) measure_mixed();
  }

 private:
  /// Purposes of random numbers.
  static constexpr std::uint64_t kAxial = 1, kDisparity = 2, kDark = 3, kDrop = 4, kAcross = 5,
                                 kAlong = 6;

  double lateral(double z) const {
    return lateral_sigma_px(noise_, job_.setup.model.camera.fx, z, 0.0);
  }
  bool mixes() const { return noise_.footprint_px > 0.0 || lateral(1.0) > 0.0; }

  /// Up to three sigma of the nearest surface.
  int radius() const {
    float nearest = 1e9f;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (counts_[i] != 0) nearest = std::min(nearest, job_.exact.z[i]);
    const double reach = 0.5 * noise_.footprint_px + 3.0 * lateral(nearest) - 0.5;
    return static_cast<int>(std::clamp(std::ceil(reach), 0.0, double(kMaxRadius)));
  }

  std::size_t pixel_of(std::size_t i) const {
    const PixelRect& r = job_.exact.rect;
    const auto w = static_cast<std::size_t>(r.width());
    return job_.setup.pixel(r.left + int(i % w), r.top + int(i / w));
  }

  /// Standard normals of a row, for each required purpose.
  void draw_row(int v) {
    const PixelRect& r = job_.exact.rect;
    const auto n = static_cast<std::size_t>(r.width());
    const auto first = static_cast<std::uint32_t>(job_.setup.pixel(r.left, v));
    const auto draw = [&](std::uint64_t purpose, bool wanted) {
      auto& row = normals_[purpose];
      row.resize(n, 0.0f);
      const std::vector<float>& alike = alike_[purpose];
      if (wanted && !alike.empty())
        std::copy_n(alike.begin() + std::ptrdiff_t(job_.exact.index(r.left, v)), n, row.begin());
      else if (wanted)
        NoiseKernels::current().normals(job_.key_of(purpose), first, 1, int(n), row.data());
    };
    draw(kAxial, true);
    draw(kDisparity, noise_.disparity_sigma_px > 0.0);
    draw(kDark, noise_.dark_jitter > 0.0 && noise_.dark_signal_per_m2 > 0.0);
  }

  /// The same numbers for a single pixel.
  double normal_of(std::uint64_t purpose, std::size_t pixel) const {
    float out = 0.0f;
    NoiseKernels::current().normals(job_.key_of(purpose), static_cast<std::uint32_t>(pixel), 1, 1,
                                    &out);
    return out;
  }

  Seen seen(const Samples& samples, std::size_t i, double x, double y) const {
    return seen_in_line(samples, i, Vec3d(x, y, 1.0), Vec3d(x, y, 1.0));
  }

  /// The surface seen by a ray `there`, with its depth extrapolated along the surface to the line
  /// of sight `here`: lateral noise determines which surface is seen; its effect on a slope is part
  /// of the axial formula.
  Seen seen_in_line(const Samples& samples, std::size_t i, const Vec3d& there,
                    const Vec3d& here) const {
    const Vec3d n = surfaces_.normal(samples, i);
    const double along_there = std::abs(n.dot(there)), along_here = std::abs(n.dot(here));
    Seen s;
    s.z = samples.z[i];
    s.facing = std::min(along_there / there.norm(), 1.0);
    s.signal = surfaces_.albedo(samples, i) * s.facing / (s.z * s.z);
    const double most = kSteepestSlope * s.z * (there - here).norm();
    s.z += std::clamp(s.z * (along_there / std::max(along_here, 1e-9) - 1.0), -most, most);
    return s;
  }

  Vec3d line_of_sight(std::size_t pixel) const {
    return {job_.setup.rays.x()[pixel], job_.setup.rays.y()[pixel], 1.0};
  }

  Seen seen_alone(int u, int v, std::size_t i) const {
    const std::size_t pixel = job_.setup.pixel(u, v);
    return seen(job_.exact, i, job_.setup.rays.x()[pixel], job_.setup.rays.y()[pixel]);
  }

  /// A pixel within reach of a step is displaced by lateral noise; rays are traced only if its
  /// footprint there intersects the step.
  void look_aside(int u, int v, std::size_t i) {
    if (job_.exact.miss[i] == Miss::kOutOfView) return;
    const std::size_t pixel = job_.setup.pixel(u, v);
    const double z = job_.exact.hit(i) ? double(job_.exact.z[i]) : nearest_around(u, v);
    if (!(z > 0.0)) return;
    const double facing = counts_[i] != 0 ? seen_alone(u, v, i).facing : 1.0;
    // The formula's steep end would displace the ray arbitrarily.
    const double sigma =
        std::min(lateral_sigma_px(noise_, job_.setup.model.camera.fx, z, std::acos(facing)),
                 2.0 * lateral(z));
    const double du = sigma * normal_of(kAcross, pixel), dv = sigma * normal_of(kAlong, pixel);
    if (meets_step(u + du, v + dv)) {
      rays_.add(job_.setup, u, v, i, noise_.footprint_px > 0.0 ? kMixedPixelRays : 1,
                noise_.footprint_px, du, dv);
      return;
    }
    // Beyond the image's border the border pixels are continued.
    const int x = std::clamp(int(std::lround(u + du)), 0, job_.exact.width - 1);
    const int y = std::clamp(int(std::lround(v + dv)), 0, job_.exact.height - 1);
    if (!job_.exact.contains(x, y)) return lose(i, Miss::kNothing);
    const std::size_t there = job_.exact.index(x, y);
    if (counts_[there] == 0) return lose(i, job_.exact.miss[there]);
    job_.out.miss[i] = Miss::kNone;
    measure(i, pixel, u - job_.exact.rect.left,
            seen_in_line(job_.exact, there, line_of_sight(job_.setup.pixel(x, y)),
                         line_of_sight(pixel)));
  }

  /// Whether one of the pixels under the footprint about (u, v) is at a step.
  bool meets_step(double u, double v) const {
    const double half = 0.5 * noise_.footprint_px;
    for (int y = int(std::lround(v - half)); y <= int(std::lround(v + half)); ++y)
      for (int x = int(std::lround(u - half)); x <= int(std::lround(u + half)); ++x)
        if (job_.exact.contains(x, y) && steps_[job_.exact.index(x, y)] != 0) return true;
    return false;
  }

  /// Nearest depth within reach of the noise.
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
        normals_[purpose].assign(
            1, alike_[purpose].empty() ? float(normal_of(purpose, pixel)) : alike_[purpose][i]);
      measure(i, pixel, 0, mixed(p, i));
    }
  }

  /// The mean of all returns, each weighted by its light; z = 0 if there are none or the sensor
  /// sees through the surface.
  Seen mixed(std::size_t p, std::size_t i) {
    double light = 0.0, z = 0.0, facing = 0.0, nearest = 1e9, farthest = 0.0;
    Miss miss = rays_.samples.miss[p * rays_.each];
    const Vec3d centre = line_of_sight(pixel_of(i));
    for (std::size_t k = p * rays_.each; k < (p + 1) * rays_.each; ++k) {
      if (!rays_.samples.counts(k)) continue;
      const Seen s = seen_in_line(rays_.samples, k, Vec3d(rays_.x[k], rays_.y[k], 1.0), centre);
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
    if (incidence <= noise_.drop_from_rad || noise_.drop_from_rad >= kTurn / 4) return false;
    if (incidence >= noise_.drop_to_rad) return true;
    const double chance =
        (incidence - noise_.drop_from_rad) / (noise_.drop_to_rad - noise_.drop_from_rad);
    return uniform01(mix64(drop_seed_ ^ pixel)) < chance;
  }

  /// `at`: index of its normals in their rows.
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
    // The measured sigma already includes the steps.
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
  Mask steps_;  ///< pixels at a step
  std::uint64_t drop_seed_;
  int radius_ = 0;                             ///< pixels around a step that are examined
  std::array<std::vector<float>, 4> normals_;  ///< by purpose
  std::array<std::vector<float>, 4> alike_;    ///< by purpose and position; empty: each computed
                                               ///< separately
  SubSamples rays_;
};

}  // namespace

void apply_formulae(Job& job) {
  Formulae(job).run();
  match_windows(job);
}

}  // namespace turnscan::noise
