#include <cmath>
#include <turnscan/simulator/noise/kinect_v2.hpp>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr std::uint64_t kCorrelations = 1, kGrazing = 2;
constexpr double kFarthest_m = 1e4;  // no light returns from there

/// Surface that is out of range returns light, too.
bool lit(const Samples& samples, std::size_t i) {
  const Miss miss = samples.miss[i];
  return samples.hit(i) && (miss == Miss::kNone || miss == Miss::kTooNear ||
                            miss == Miss::kTooFar || miss == Miss::kGrazing);
}

Miss miss_of(std::uint8_t verdict) {
  switch (verdict) {
    case kGood:
      return Miss::kNone;
    case kDark:
      return Miss::kTooDark;
    case kNear:
      return Miss::kTooNear;
    case kFar:
      return Miss::kTooFar;
    default:
      return Miss::kRejected;
  }
}

/// The light on the pixels of a rectangle at one moment.
class Illumination {
 public:
  Illumination(const Setup& setup, const SensorView& view, const SampleGrid& exact,
               const PixelRect& rect, std::uint64_t grazing_seed, kinect_v2::Light& light)
      : setup_(setup),
        view_(view),
        exact_(exact),
        rect_(rect),
        surfaces_(view),
        lit_(exact.size()),
        grazing_seed_(grazing_seed),
        light_(light) {
    for (std::size_t i = 0; i < lit_.size(); ++i) lit_[i] = lit(exact, i) ? 1 : 0;
  }

  /// Pixels that see a plane have one phasor, those at steps the sum of many.
  void fill() {
    light_.reset({rect_.width(), rect_.height()});
    const double footprint = setup_.model.noise.footprint_px;
    const int radius = static_cast<int>(std::ceil(std::max(0.5 * footprint - 0.5, 0.0)));
    const Mask mixed = footprint > 0.0 ? steps_of(exact_, lit_, radius) : Mask(exact_.size(), 0);
    for (int v = rect_.top; v < rect_.bottom; ++v) fill_row(v, mixed, footprint);
    if (!rays_.index.empty()) add_mixed();
  }

 private:
  struct Return {
    float half_path, amplitude;
  };

  /// pixel: the measuring one, for its random number.
  Return returned(const Samples& samples, std::size_t i, double x, double y,
                  std::size_t pixel) const {
    const NoiseModel& model = setup_.model.noise;
    const Vec3d p = double(samples.z[i]) * Vec3d(x, y, 1.0);
    const double range = p.norm();
    if (range > kFarthest_m) return {0.0f, 0.0f};
    const double back = (p - setup_.model.emitter_m).norm();
    const double facing = surfaces_.facing(samples, i, x, y);
    const double amplitude =
        model.tof_amplitude * surfaces_.albedo(samples, i) * facing / (range * range);
    double half_path = 0.5 * (range + back);
    if (model.axial_grazing > 0.0) {
      const double z = samples.z[i];
      const double sigma = kinect_v2::grazing_sigma_m(model, z, std::acos(facing));
      if (sigma > 0.0)
        half_path += sigma * range / z * standard_normal(hash_key(grazing_seed_, pixel));
    }
    return {float(std::max(half_path, 0.0)), float(amplitude)};
  }

  void fill_row(int v, const Mask& mixed, double footprint) {
    std::vector<float> half(std::size_t(rect_.width()), 0.0f), amplitude(half.size(), 0.0f);
    for (int u = rect_.left; u < rect_.right; ++u) {
      if (!exact_.contains(u, v)) continue;
      const std::size_t i = exact_.index(u, v), k = std::size_t(u - rect_.left);
      if (mixed[i] != 0) {
        rays_.add(setup_, u, v, light_.layout.at(u - rect_.left, v - rect_.top), kMixedPixelRays,
                  footprint, 0.0, 0.0);
        pixels_.push_back(setup_.pixel(u, v));
      }
      if (mixed[i] != 0 || lit_[i] == 0) continue;
      const std::size_t pixel = setup_.pixel(u, v);
      const Return back =
          returned(exact_, i, setup_.rays.x()[pixel], setup_.rays.y()[pixel], pixel);
      half[k] = back.half_path;
      amplitude[k] = back.amplitude;
    }
    const int y = v - rect_.top;
    NoiseKernels::current().phasors(rect_.width(), half.data(), amplitude.data(), light_.row(y));
    std::copy(amplitude.begin(), amplitude.end(),
              light_.amplitude.begin() + std::ptrdiff_t(light_.layout.at(0, y)));
  }

  void add_mixed() {
    view_.tracer.trace(view_.bodies, view_.T_world_sensor, rays_.x, rays_.y, rays_.samples);
    const std::size_t n = rays_.samples.size();
    std::vector<float> half(n, 0.0f), amplitude(n, 0.0f);
    for (std::size_t k = 0; k < n; ++k) {
      if (!lit(rays_.samples, k)) continue;
      const Return back =
          returned(rays_.samples, k, rays_.x[k], rays_.y[k], pixels_[k / rays_.each]);
      half[k] = back.half_path;
      amplitude[k] = back.amplitude / float(rays_.each);
    }
    std::array<kinect_v2::Plane, kFrequencies> re, im;
    Phasors phasors{};
    for (std::size_t f = 0; f < re.size(); ++f) {
      re[f].resize(n);
      im[f].resize(n);
      phasors.re[f] = re[f].data();
      phasors.im[f] = im[f].data();
    }
    NoiseKernels::current().phasors(int(n), half.data(), amplitude.data(), phasors);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t at = rays_.index[k / rays_.each];
      light_.amplitude[at] += amplitude[k];
      for (std::size_t f = 0; f < re.size(); ++f) {
        light_.re[f][at] += re[f][k];
        light_.im[f][at] += im[f][k];
      }
    }
  }

  const Setup& setup_;
  const SensorView& view_;
  const SampleGrid& exact_;
  const PixelRect& rect_;
  Surfaces surfaces_;
  Mask lit_;
  std::uint64_t grazing_seed_;
  kinect_v2::Light& light_;
  SubSamples rays_;  ///< of mixed pixels; index: in the light's layout
  std::vector<std::size_t> pixels_;
};

class TimeOfFlight {
 public:
  explicit TimeOfFlight(Job& job)
      : job_(job), layout_{job.exact.rect.width(), job.exact.rect.height()} {}

  void run() {
    if (layout_.width <= 0 || layout_.height <= 0) return;
    kinect_v2::Raw raw;
    if (job_.view.moments.empty())
      expose(job_.view, job_.exact, raw);
    else
      expose_in_turn(raw);
    kinect_v2::Workspace work;
    kinect_v2::Decoded decoded;
    const ScannerModel& model = job_.setup.model;
    kinect_v2::decode(raw, lines_of_sight(), {float(model.near_m), float(model.far_m)}, work,
                      decoded);
    deliver(decoded);
  }

 private:
  /// Exposes all nine images of one moment.
  void expose(const SensorView& view, const SampleGrid& exact, kinect_v2::Raw& raw) {
    const PixelRect& r = job_.exact.rect;
    Illumination(job_.setup, view, exact, r, job_.seed_of(kGrazing), light_).fill();
    kinect_v2::expose(light_, job_.setup.model.noise, job_.key_of(kCorrelations),
                      std::uint32_t(job_.setup.pixel(r.left, r.top)),
                      std::uint32_t(job_.setup.model.camera.width), raw);
  }

  /// Exposes one image per moment: frequency by frequency, phase by phase.
  void expose_in_turn(kinect_v2::Raw& raw) {
    kinect_v2::Raw all;
    raw.layout = layout_;
    for (std::size_t k = 0; k < raw.correlations.size(); ++k) {
      const SensorMoment& moment = job_.view.moments[k];
      expose({job_.view.tracer, moment.bodies, moment.T_world_sensor, job_.view.albedo, {}},
             moment.exact, all);
      raw.correlations[k].swap(all.correlations[k]);
    }
  }

  kinect_v2::Rays lines_of_sight() const {
    const Vec3d& emitter = job_.setup.model.emitter_m;
    kinect_v2::Rays rays{kinect_v2::Plane(layout_.size(), 1.0f),
                         kinect_v2::Plane(layout_.size(), 0.0f), float(emitter.squaredNorm())};
    const PixelRect& r = job_.exact.rect;
    for (int v = r.top; v < r.bottom; ++v) {
      for (int u = r.left; u < r.right; ++u) {
        const std::size_t pixel = job_.setup.pixel(u, v), at = layout_.at(u - r.left, v - r.top);
        const double x = job_.setup.rays.x()[pixel], y = job_.setup.rays.y()[pixel];
        const double z = 1.0 / std::sqrt(x * x + y * y + 1.0);
        rays.z_per_range[at] = float(z);
        rays.along_emitter[at] = float(z * (x * emitter.x() + y * emitter.y() + emitter.z()));
      }
    }
    return rays;
  }

  void deliver(const kinect_v2::Decoded& decoded) {
    const PixelRect& r = job_.exact.rect;
    for (int v = r.top; v < r.bottom; ++v) {
      for (int u = r.left; u < r.right; ++u) {
        const std::size_t i = job_.exact.index(u, v), at = layout_.at(u - r.left, v - r.top);
        const Miss miss = miss_of(decoded.verdict[at]);
        if (miss == Miss::kNone) {
          job_.out.z[i] = decoded.z[at] + float(job_.setup.model.noise.bias_m);
          job_.out.miss[i] = Miss::kNone;
        } else if (job_.exact.counts(i)) {
          job_.out.miss[i] = miss;
        }
      }
    }
  }

  Job& job_;
  kinect_v2::Layout layout_;
  kinect_v2::Light light_;
};

}  // namespace

void apply_time_of_flight(Job& job) { TimeOfFlight(job).run(); }

}  // namespace turnscan::noise
