#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/simulator/color/color_image.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/scan_image.hpp>
#include <turnscan/simulator/virtual_bench.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

namespace turnscan {

namespace {

TurntableInfo turntable_of(const Pose& T_table_sensor) {
  const Pose T_sensor_table = T_table_sensor.inverse();
  TurntableInfo table;
  table.axis = T_sensor_table.linear() * Vec3d::UnitY();
  table.center_m = T_sensor_table.translation();
  return table;
}

Result<NoiseOptions> noise_options(const MeasureOptions& measure) {
  TURNSCAN_ASSIGN(NoiseOptions noise, parse_noise_options(measure.noise));
  noise.mixed_pixels = measure.mixed_pixels;
  noise.mixed_reach_m = measure.mixed_reach_m;
  noise.window_px = measure.noise_window_px;
  noise.edge_fattening_px = measure.edge_fattening_px;
  noise.wiggling_m = measure.wiggling_m;
  noise.wiggling_period_m = measure.wiggling_period_m;
  return noise;
}

/// Counts of one scanner's samples; sums do not depend on the order.
struct Tally {
  std::array<std::atomic<std::uint64_t>, kMissCount> counts{};

  void add(const SampleGrid& grid, const MeasuredGrid& measured) {
    std::array<std::uint64_t, kMissCount> here{};
    for (const Miss miss : measured.miss) ++here[static_cast<std::size_t>(miss)];
    // Pixels outside the rect see nothing.
    here[static_cast<std::size_t>(Miss::kNothing)] +=
        std::uint64_t(grid.width) * std::uint64_t(grid.height) - measured.miss.size();
    for (std::size_t k = 0; k < here.size(); ++k) counts[k] += here[k];
  }
};

/// Memory of one frame that is reused for the next one.
struct Workspace {
  SampleGrid exact;
  MeasuredGrid measured;
};

}  // namespace

struct VirtualScan::Impl {
  VirtualScanOptions options;
  NoiseOptions noise;
  std::vector<PlatterState> states;
  VirtualBench bench;
  std::vector<SampleTracer> tracers;
  std::vector<SensorNoise> noises;
  std::optional<sampling::ColorCamera> color_camera;  ///< if it takes images of its own
  Albedo albedo;                                      ///< empty if the noise does not need it
  mutable std::vector<Tally> tallies;
  TurntableInfo turntable;
  SequenceHeader header;
  std::vector<FrameInfo> frames;
  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<Workspace>> spare;  ///< guarded by mutex

  Impl(const VirtualScanOptions& o, const NoiseOptions& n, std::vector<PlatterState> s,
       VirtualBench b)
      : options(o), noise(n), states(std::move(s)), bench(std::move(b)) {}

  std::size_t scanner_count() const { return options.scanners.size(); }
  std::size_t scanner_of(std::size_t position) const { return position % scanner_count(); }
  const PlatterState& state_of(std::size_t position) const {
    return states[position / scanner_count()];
  }
  /// Instant used for the random numbers.
  std::uint32_t instant_of(std::size_t position) const {
    return options.first_instant + static_cast<std::uint32_t>(position / scanner_count());
  }

  Pose T_table_sensor(std::size_t position) const {
    const PlatterState& state = state_of(position);
    return bench.T_world_objects(state).inverse() *
           bench.T_world_sensor(scanner_of(position), state);
  }

  Result<> make_scanners() {
    const auto seed = static_cast<std::uint64_t>(options.measure.seed);
    for (std::size_t k = 0; k < scanner_count(); ++k) {
      const ScannerModel& model = options.scanners[k].model;
      TURNSCAN_ASSIGN(SampleTracer tracer, SampleTracer::create(model));
      TURNSCAN_ASSIGN(SensorNoise sensor_noise,
                      SensorNoise::create(model, noise, seed, static_cast<std::uint32_t>(k)));
      tracers.push_back(std::move(tracer));
      noises.push_back(std::move(sensor_noise));
    }
    if (noise.kind == NoiseKind::kModel || noise.kind == NoiseKind::kPhysics)
      albedo = sampling::albedo_of(bench.meshes());
    if (options.record.color && options.color_camera.width > 0) {
      TURNSCAN_ASSIGN(color_camera,
                      sampling::ColorCamera::create(options.color_camera, bench.meshes()));
    }
    tallies = std::vector<Tally>(scanner_count());
    return {};
  }

  SensorInfo sensor_info(const VirtualScanner& scanner) const {
    SensorInfo sensor;
    sensor.model = "virtual " + scanner.model.name;
    if (scanner.model.kind == ScannerKind::kLine) {
      sensor.kind = SensorKind::kPointScanner;
    } else {
      sensor.intrinsics = scanner.model.camera;
      sensor.depth_unit_m = scanner.model.depth_unit_m;
      if (options.record.color && options.color_camera.width > 0) {
        sensor.color_intrinsics = intrinsics_of(options.color_camera);
        sensor.T_color_sensor = given_T_color_sensor(options.color_camera);
      }
    }
    return sensor;
  }

  /// Pose of the table as recorded.
  Pose recorded_table() const {
    return options.record.calibration == RecordedCalibration::kTrue ? bench.T_world_table()
                                                                    : bench.T_world_meant_table();
  }

  void make_header() {
    const double travel = states.front().travel;
    turntable =
        turntable_of(bench.T_world_table().inverse() * bench.T_world_meant_sensor(0, travel));
    turntable.radius_m = options.platter.radius_m;
    if (states.size() > 1)
      turntable.speed_rad_s = (states.back().angle_rad - states.front().angle_rad) /
                              (states.back().time_s - states.front().time_s);
    for (const VirtualScanner& scanner : options.scanners)
      header.sensors.push_back(sensor_info(scanner));
    header.software = std::string("turnscan ") + version();
    header.source = "virtual scan";
    for (const TriangleMesh& mesh : bench.objects())
      header.source += (&mesh == bench.objects().data() ? " of " : ", ") +
                       (mesh.name.empty() ? std::string("object") : mesh.name);
    if (options.record.calibration == RecordedCalibration::kNone) return;
    const Pose T_table_world = recorded_table().inverse();
    for (std::size_t k = 0; k < scanner_count(); ++k)
      header.sensors[k].T_table_sensor = T_table_world * bench.T_world_meant_sensor(k, travel);
    header.turntable = turntable_of(*header.sensors[0].T_table_sensor);
    header.turntable->radius_m = turntable.radius_m;
    header.turntable->speed_rad_s = turntable.speed_rad_s;
  }

  void make_frames() {
    frames.resize(states.size() * scanner_count());
    const Pose T_table_world = recorded_table().inverse();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const PlatterState& state = state_of(i);
      const std::size_t k = scanner_of(i);
      FrameInfo& frame = frames[i];
      frame.index = static_cast<std::uint32_t>(i);
      frame.time_s = state.time_s;
      frame.sensor = static_cast<std::uint32_t>(k);
      frame.pass = static_cast<std::uint32_t>(options.record.pass);
      if (options.record.angles) frame.angle_rad = state.angle_rad;
      // The margin keeps rounding from assigning the end of a turn to the previous turn.
      const double turns = std::abs(state.angle_rad) / kTurn + 1e-9;
      frame.turn = static_cast<std::uint32_t>(std::min(turns, 4e9));
      // A travelling scanner has a pose of its own in each frame.
      if (options.scanners[k].placement.travel_m != 0.0 &&
          options.record.calibration != RecordedCalibration::kNone)
        frame.T_table_sensor = rotation_about_y(-state.angle_rad) * T_table_world *
                               bench.T_world_meant_sensor(k, state.travel);
      if (frame_dropped(options.motion, static_cast<std::uint64_t>(options.measure.seed),
                        instant_of(i), frame.sensor))
        frame.status = FrameStatus::kDropped;
    }
  }

  std::unique_ptr<Workspace> take_workspace() const {
    const std::lock_guard lock(mutex);
    if (spare.empty()) return std::make_unique<Workspace>();
    auto space = std::move(spare.back());
    spare.pop_back();
    return space;
  }

  void give_back(std::unique_ptr<Workspace> space) const {
    const std::lock_guard lock(mutex);
    spare.push_back(std::move(space));
  }

  /// Depth offset of a scanner that is not warm yet.
  double too_far_m(std::size_t position) const {
    const MeasureOptions& measure = options.measure;
    if (measure.warm_up_m == 0.0) return 0.0;
    return measure.warm_up_m * std::exp(-state_of(position).time_s / measure.warm_up_time_s);
  }

  /// Empty without an exposure.
  std::vector<SensorMoment> moments_of(std::size_t position) const {
    const double exposure_s = options.measure.exposure_s;
    std::vector<SensorMoment> moments(exposure_s > 0.0 ? kExposureMoments : 0);
    const std::size_t k = scanner_of(position);
    for (std::size_t j = 0; j < moments.size(); ++j) {
      const double share = (double(j) + 0.5) / double(moments.size()) - 0.5;
      const PlatterState state =
          platter_state_at(options.motion, state_of(position).time_s + share * exposure_s);
      moments[j].bodies = bench.bodies_at(state);
      moments[j].T_world_sensor = bench.T_world_sensor(k, state);
      tracers[k].trace(moments[j].bodies, moments[j].T_world_sensor, moments[j].exact);
    }
    return moments;
  }

  ColorImage color_image(const SensorView& view, const SampleGrid& exact,
                         const sampling::Paint& paint) const {
    if (view.moments.empty())
      return sampling::color_image(view.tracer, view.bodies, view.T_world_sensor, exact, paint);
    std::vector<ColorImage> images;
    for (const SensorMoment& moment : view.moments)
      images.push_back(sampling::color_image(view.tracer, moment.bodies, moment.T_world_sensor,
                                             moment.exact, paint));
    return sampling::mean_image(images);
  }

  /// From a separate colour camera; over the exposure.
  ColorImage own_color_image(std::size_t position) const {
    const std::size_t k = scanner_of(position);
    const auto seed = static_cast<std::uint64_t>(options.measure.seed);
    const std::uint64_t key = hash_key(seed, 0x636f6c6f, instant_of(position), k);
    const double middle_s = state_of(position).time_s + late_s(options.color_camera, key);
    const double exposure_s = options.measure.exposure_s;
    const std::size_t moments = exposure_s > 0.0 ? kExposureMoments : 1;
    Image<Vec3f> light;
    for (std::size_t j = 0; j < moments; ++j) {
      const double share = (double(j) + 0.5) / double(moments) - 0.5;
      const PlatterState state = platter_state_at(options.motion, middle_s + share * exposure_s);
      Image<Vec3f> one =
          color_camera->light(bench.bodies_at(state), bench.T_world_sensor(k, state));
      if (moments == 1) {
        light = std::move(one);
        break;
      }
      if (light.empty()) light = Image<Vec3f>(one.width, one.height, Vec3f::Zero());
      for (std::size_t i = 0; i < one.pixels.size(); ++i)
        light.pixels[i] += one.pixels[i] / float(moments);
    }
    return color_camera->exposed(light, key);
  }

  TrueSamples true_samples(std::size_t position) const {
    const std::size_t k = scanner_of(position);
    const PlatterState& state = state_of(position);
    const Pose T = bench.T_world_sensor(k, state);
    const std::vector<Body> bodies = bench.bodies_at(state);
    TrueSamples out;
    out.scanner = static_cast<std::uint32_t>(k);
    out.bodies = bench.kinds();
    tracers[k].trace(bodies, T, out.exact);
    const std::vector<SensorMoment> moments = moments_of(position);
    const SensorView view{tracers[k],         bodies, T, albedo ? &albedo : nullptr, moments,
                          too_far_m(position)};
    noises[k].apply(view, out.exact, instant_of(position), out.measured);
    take_hits(out, bodies, T);
    return out;
  }

  void take_hits(TrueSamples& out, std::span<const Body> bodies, const Pose& T) const {
    const SampleTracer& tracer = tracers[out.scanner];
    out.hits.resize(out.exact.size());
    const PixelRect& rect = out.exact.rect;
    for (int row = rect.top; row < rect.bottom; ++row) {
      for (int column = rect.left; column < rect.right; ++column) {
        const std::size_t i = out.exact.index(column, row);
        if (!out.exact.hit(i)) continue;
        SampleHit& hit = out.hits[i];
        hit = tracer.hit_of(bodies, T, out.exact, i, tracer.direction(column, row));
        const std::size_t body = out.exact.body(i);
        if (out.bodies[body] != BodyKind::kHand) continue;
        hit.p_body = bodies[body].T_world_body * hit.p_body;
        hit.normal_body = bodies[body].T_world_body.linear() * hit.normal_body;
      }
    }
  }

  Frame render(std::size_t position, Workspace& space) const {
    const std::size_t k = scanner_of(position);
    const PlatterState& state = state_of(position);
    const Pose T = bench.T_world_sensor(k, state);
    const std::vector<Body> bodies = bench.bodies_at(state);
    tracers[k].trace(bodies, T, space.exact);
    const std::vector<SensorMoment> moments = moments_of(position);
    const SensorView view{tracers[k],         bodies, T, albedo ? &albedo : nullptr, moments,
                          too_far_m(position)};
    noises[k].apply(view, space.exact, instant_of(position), space.measured);
    tallies[k].add(space.exact, space.measured);
    const sampling::Paint paint(bench.meshes());
    const bool color = options.record.color;
    Frame frame;
    frame.info = frames[position];
    if (options.scanners[k].model.kind == ScannerKind::kLine) {
      frame.points = sampling::scan_points(tracers[k], bodies, T, space.exact, space.measured.z,
                                           color ? &paint : nullptr);
      return frame;
    }
    frame.depth = sampling::depth_image(space.exact, space.measured.z,
                                        options.scanners[k].model.depth_unit_m);
    if (color)
      frame.color =
          color_camera ? own_color_image(position) : color_image(view, space.exact, paint);
    return frame;
  }
};

VirtualScan::VirtualScan(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VirtualScan::VirtualScan(VirtualScan&&) noexcept = default;
VirtualScan& VirtualScan::operator=(VirtualScan&&) noexcept = default;
VirtualScan::~VirtualScan() = default;

Result<VirtualScan> VirtualScan::create(std::vector<TriangleMesh> objects,
                                        const VirtualScanOptions& options) {
  TURNSCAN_TRY(check(options));
  TURNSCAN_ASSIGN(const NoiseOptions noise, noise_options(options.measure));
  TURNSCAN_ASSIGN(std::vector<PlatterState> states, platter_states(options.motion));
  TURNSCAN_TRY(check_moments(options, states.back().time_s + 1.0 / options.motion.fps));
  TURNSCAN_ASSIGN(VirtualBench bench,
                  VirtualBench::create(std::move(objects), options, states.front()));
  auto impl = std::make_unique<Impl>(options, noise, std::move(states), std::move(bench));
  TURNSCAN_TRY(impl->make_scanners());
  impl->make_header();
  impl->make_frames();
  return VirtualScan(std::move(impl));
}

const SequenceHeader& VirtualScan::header() const { return impl_->header; }
const std::vector<FrameInfo>& VirtualScan::frames() const { return impl_->frames; }
std::array<std::uint64_t, kMissCount> VirtualScan::tally(std::size_t scanner) const {
  std::array<std::uint64_t, kMissCount> counts{};
  for (std::size_t k = 0; k < counts.size(); ++k)
    counts[k] = impl_->tallies.at(scanner).counts[k].load();
  return counts;
}

std::span<const TriangleMesh> VirtualScan::objects() const { return impl_->bench.objects(); }
const Scene& VirtualScan::scene() const { return impl_->bench.scene(); }
const Scene* VirtualScan::room() const { return impl_->bench.room(); }
double VirtualScan::aim_height_m() const { return impl_->bench.aim_height_m(); }
const TurntableInfo& VirtualScan::turntable() const { return impl_->turntable; }
Pose VirtualScan::T_table_given() const { return impl_->bench.T_table_given(); }

Pose VirtualScan::T_table_sensor(std::size_t position) const {
  return impl_->T_table_sensor(position);
}

Pose VirtualScan::T_table_world(std::size_t position) const {
  return impl_->bench.T_world_objects(impl_->state_of(position)).inverse();
}

double VirtualScan::angle_rad(std::size_t position) const {
  return impl_->state_of(position).angle_rad;
}

Result<Frame> VirtualScan::read(std::size_t position) const {
  if (position >= impl_->frames.size())
    return fail(ErrorCode::kNotFound, "virtual scan: there is no frame {}, only {}", position,
                impl_->frames.size());
  if (impl_->frames[position].status == FrameStatus::kDropped)
    return fail(ErrorCode::kMissingData, "virtual scan: frame {} was dropped", position);
  auto space = impl_->take_workspace();
  Frame frame = impl_->render(position, *space);
  impl_->give_back(std::move(space));
  return frame;
}

Result<TrueSamples> VirtualScan::samples(std::size_t position) const {
  if (position >= impl_->frames.size())
    return fail(ErrorCode::kNotFound, "virtual scan: there is no frame {}, only {}", position,
                impl_->frames.size());
  return impl_->true_samples(position);
}

}  // namespace turnscan
