#include <cmath>
#include <turnscan/sensors/laser_line.hpp>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr std::uint64_t kElectrons = 1, kSpeckle = 2;

class LaserLine {
 public:
  explicit LaserLine(Job& job)
      : job_(job),
        noise_(job.setup.model.noise),
        surfaces_(job.view),
        strips_(line_strips_m(noise_)),
        // Towards the camera.
        side_(job.setup.model.receiver_m.x() < 0.0 ? -1.0 : 1.0),
        // Fixed to the surface rather than to the frame.
        speckle_seed_(hash_key(job.setup.seed, job.setup.scanner, kSpeckle)) {}

  void run() {
    add_rays();
    if (index_.empty()) return;
    job_.view.tracer.trace(job_.view.bodies, job_.view.T_world_sensor, x_, y_, samples_);
    const std::uint64_t electrons = job_.seed_of(kElectrons);
    std::vector<LineSpot> spots;
    for (std::size_t p = 0; p < index_.size(); ++p) {
      spots_of(p, spots);
      deliver(index_[p], spots, mix64(electrons ^ pixel_[p]));
    }
  }

 private:
  /// The width of the line is a length; if the sample itself hits nothing, it is taken at the last
  /// depth.
  void add_rays() {
    const SampleGrid& exact = job_.exact;
    double z = job_.setup.model.far_m;
    for (int v = exact.rect.top; v < exact.rect.bottom; ++v) {
      for (int u = exact.rect.left; u < exact.rect.right; ++u) {
        const std::size_t i = exact.index(u, v), pixel = job_.setup.pixel(u, v);
        if (exact.hit(i)) z = exact.z[i];
        index_.push_back(i);
        pixel_.push_back(pixel);
        for (const double beside : strips_) {
          x_.push_back(float(job_.setup.rays.x()[pixel] + side_ * beside / z));
          y_.push_back(job_.setup.rays.y()[pixel]);
        }
      }
    }
  }

  void spots_of(std::size_t p, std::vector<LineSpot>& spots) const {
    const double width = strips_.size() > 1 ? strips_[1] - strips_[0] : noise_.line_width_m;
    spots.clear();
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      const std::size_t ray = p * strips_.size() + k;
      if (!samples_.counts(ray)) continue;
      const Vec3d direction(x_[ray], y_[ray], 1.0);
      const SampleHit hit = job_.view.tracer.hit_of(job_.view.bodies, job_.view.T_world_sensor,
                                                    samples_, ray, direction);
      const double light =
          line_light(noise_, samples_.z[ray], hit.incidence_rad, surfaces_.albedo(samples_, ray)) *
          line_profile(noise_, strips_[k]) * speckle(ray, hit);
      spots.push_back({side_ * hit.p_sensor.x(), hit.p_sensor.z(), light, width});
    }
  }

  double speckle(std::size_t ray, const SampleHit& hit) const {
    const Body& body = job_.view.bodies[samples_.body(ray)];
    const Vec3d to_camera = (job_.setup.model.receiver_m - hit.p_sensor).normalized();
    const Vec3d to_camera_body =
        body.T_world_body.linear().transpose() * (job_.view.T_world_sensor.linear() * to_camera);
    return speckle_factor(noise_, speckle_seed_, hit.p_body, to_camera_body);
  }

  void deliver(std::size_t i, const std::vector<LineSpot>& spots, std::uint64_t key) {
    if (spots.empty()) {
      if (job_.exact.counts(i)) job_.out.miss[i] = Miss::kEmitterBlocked;
      return;
    }
    const auto z = measure_line(noise_, job_.setup.focal_baseline, spots, key);
    const ScannerModel& model = job_.setup.model;
    if (!z) {
      job_.out.miss[i] = Miss::kTooDark;
    } else if (*z < model.near_m || *z > model.far_m) {
      job_.out.miss[i] = Miss::kRejected;
    } else {
      job_.out.z[i] = float(*z + noise_.bias_m);
      job_.out.miss[i] = Miss::kNone;
    }
  }

  Job& job_;
  const NoiseModel& noise_;
  Surfaces surfaces_;
  std::vector<double> strips_;
  double side_;
  std::uint64_t speckle_seed_;
  std::vector<std::size_t> index_, pixel_;
  std::vector<float> x_, y_;  ///< strips_.size() per entry of index_
  Samples samples_;
};

}  // namespace

void apply_laser_line(Job& job) { LaserLine(job).run(); }

}  // namespace turnscan::noise
