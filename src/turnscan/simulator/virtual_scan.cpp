#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/scan_image.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMostScanners = 64;  // that a recording holds

TurntableInfo turntable_of(const Pose& T_table_sensor) {
  const Pose T_sensor_table = T_table_sensor.inverse();
  TurntableInfo table;
  table.axis = T_sensor_table.linear() * Vec3d::UnitY();
  table.center_m = T_sensor_table.translation();
  return table;
}

/// Half the height that the objects reach above the platter.
double middle_of(const std::vector<TriangleMesh>& objects) {
  double top = 0.0;
  for (const TriangleMesh& mesh : objects)
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t)
        if (v < mesh.vertices.size()) top = std::max(top, double(mesh.vertices[v].y()));
  return std::isfinite(top) ? 0.5 * top : 0.0;
}

void turn(TriangleMesh& mesh, double yaw_rad) {
  if (yaw_rad == 0.0) return;
  const Eigen::Matrix3d R = rotation_about_y(yaw_rad).linear();
  for (Vec3f& p : mesh.vertices) p = (R * p.cast<double>()).cast<float>();
  for (Vec3f& n : mesh.normals) n = (R * n.cast<double>()).cast<float>();
}

template <class Options>
Result<> check(const Options& options) {
  Options copy = options;
  return describe(copy).check();
}

Result<> check_options(const VirtualScanOptions& o) {
  if (o.scanners.empty() || o.scanners.size() > kMostScanners)
    return fail(ErrorCode::kInvalidOption, "there are {} scanners; give 1 to {}", o.scanners.size(),
                kMostScanners);
  for (const VirtualScanner& scanner : o.scanners) {
    TURNSCAN_TRY(scanner.model.check());
    TURNSCAN_TRY(check(scanner.placement));
  }
  TURNSCAN_TRY(check(o.platter));
  TURNSCAN_TRY(check(o.table));
  TURNSCAN_TRY(check(o.room));
  TURNSCAN_TRY(check(o.measure));
  return check(o.record);
}

Result<NoiseOptions> noise_options(const MeasureOptions& measure) {
  TURNSCAN_ASSIGN(NoiseOptions noise, parse_noise_options(measure.noise));
  noise.mixed_pixels = measure.mixed_pixels;
  noise.mixed_reach_m = measure.mixed_reach_m;
  return noise;
}

/// Counts of one scanner's samples; sums do not depend on the order.
struct Tally {
  std::array<std::atomic<std::uint64_t>, kMissCount> counts{};

  void add(const SampleGrid& grid, const MeasuredGrid& measured) {
    std::array<std::uint64_t, kMissCount> here{};
    for (const Miss miss : measured.miss) ++here[static_cast<std::size_t>(miss)];
    // Around the rect nothing is seen.
    here[static_cast<std::size_t>(Miss::kNothing)] +=
        std::uint64_t(grid.width) * std::uint64_t(grid.height) - measured.miss.size();
    for (std::size_t k = 0; k < here.size(); ++k) counts[k] += here[k];
  }
};

/// Memory of one frame that the next one uses again.
struct Workspace {
  SampleGrid exact;
  MeasuredGrid measured;
};

}  // namespace

OptionTable describe(PlatterOptions& o) {
  OptionTable table;
  table.flag("platter", o.visible, "Whether there is a platter to be seen.")
      .number("platter-radius", o.radius_m, Quantity::kLength, {1e-3, 10.0},
              "Radius of the platter.")
      .number("platter-thickness", o.thickness_m, Quantity::kLength, {0.0, 1.0},
              "Thickness of the platter; 0: a disc.");
  return table;
}

OptionTable describe(MeasureOptions& o) {
  OptionTable table;
  table
      .text("noise", o.noise,
            "Depth noise: none, gaussian:SIGMA (e.g. gaussian:1.5mm), model (the formulae of the "
            "scanner's file) or physics (the sensor's own measuring, where the file names it).")
      .number("mixed-pixels", o.mixed_pixels, Quantity::kNone, {0.0, 1.0},
              "With gaussian noise: share of the silhouette's pixels that return a depth between "
              "edge and background. The other kinds mix what a pixel really sees.")
      .number("mixed-reach", o.mixed_reach_m, Quantity::kLength, {0.0, 10.0},
              "How far behind the edge such a pixel may lie.")
      .number("seed", o.seed, {0, 2147483647}, "Seed of all random numbers.");
  return table;
}

OptionTable describe(RecordOptions& o) {
  OptionTable table;
  table
      .choice("calibration", o.calibration, {"true", "nominal", "none"},
              "What the recording says of the turntable: where it is; where it was meant to be "
              "(without the table's offset and tilt); or nothing.")
      .flag("angles", o.angles, "Whether the recording says how far the platter has turned.")
      .flag("scan-colour", o.color, "Also record colours.")
      .number("pass", o.pass, {0, 1000000}, "Number of the way in which the object lies.");
  return table;
}

struct VirtualScan::Impl {
  VirtualScanOptions options;
  NoiseOptions noise;
  double aim_height_m = 0.0;
  double yaw_rad = 0.0;
  std::vector<PlatterState> states;
  Pose T_world_table = Pose::Identity();
  std::vector<TriangleMesh> turning;  ///< objects, then the platter's body; table frame
  std::size_t object_count = 0;
  std::vector<TriangleMesh> standing;  ///< the room; empty without
  std::optional<Scene> scene, room;
  std::vector<SampleTracer> tracers;
  std::vector<SensorNoise> noises;
  Albedo albedo;  ///< none where no noise asks for it
  mutable std::vector<Tally> tallies;
  TurntableInfo turntable;
  SequenceHeader header;
  std::vector<FrameInfo> frames;
  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<Workspace>> spare;  ///< guarded by mutex

  Impl(const VirtualScanOptions& o, const NoiseOptions& n, std::vector<PlatterState> s)
      : options(o), noise(n), states(std::move(s)) {}

  std::size_t scanner_count() const { return options.scanners.size(); }
  std::size_t scanner_of(std::size_t position) const { return position % scanner_count(); }
  const PlatterState& state_of(std::size_t position) const {
    return states[position / scanner_count()];
  }
  /// For the random numbers.
  std::uint32_t instant_of(std::size_t position) const {
    return options.first_instant + static_cast<std::uint32_t>(position / scanner_count());
  }

  Pose T_world_sensor(std::size_t scanner, double travel) const {
    return scanner_pose(options.scanners[scanner].placement, aim_height_m, travel,
                        T_world_table.linear().col(1));
  }

  Pose T_world_platter(double angle_rad) const {
    Pose wobble = Pose::Identity();
    wobble.linear() = axis_wobble(options.motion, angle_rad);
    return T_world_table * wobble * rotation_about_y(angle_rad);
  }

  Pose T_table_sensor(std::size_t position) const {
    const PlatterState& state = state_of(position);
    return T_world_platter(state.angle_rad).inverse() *
           T_world_sensor(scanner_of(position), state.travel);
  }

  void place(std::vector<TriangleMesh> given) {
    aim_height_m = middle_of(given);
    const Pose T = table_pose(options.table);
    T_world_table = T;  // the travel of scanner 0 may follow its axis
    yaw_rad = canonical_yaw(T, T_world_sensor(0, states.front().travel));
    T_world_table = T * rotation_about_y(yaw_rad);
    for (TriangleMesh& mesh : given) turn(mesh, -yaw_rad);
    turning = std::move(given);
    object_count = turning.size();
  }

  Result<> build_scenes() {
    const PlatterOptions& platter = options.platter;
    if (platter.visible && platter.thickness_m > 0.0)
      turning.push_back(platter_body(platter.radius_m, platter.thickness_m));
    TURNSCAN_ASSIGN(scene, Scene::create(turning, platter.visible ? std::optional(platter.radius_m)
                                                                  : std::nullopt));
    if (options.room.kind == RoomKind::kNone) return {};
    std::vector<Vec3d> places;
    for (std::size_t k = 0; k < scanner_count(); ++k)
      places.push_back(T_world_sensor(k, 0.5).translation());
    standing.push_back(make_room(options.room, T_world_table.translation(), platter.radius_m,
                                 platter.thickness_m, places,
                                 static_cast<std::uint64_t>(options.measure.seed)));
    TURNSCAN_ASSIGN(room, Scene::create(standing));
    return {};
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
      albedo = sampling::albedo_of({turning, standing});
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
    }
    return sensor;
  }

  /// Where the table is, as the recording has it.
  Pose recorded_table() const {
    if (options.record.calibration == RecordedCalibration::kTrue) return T_world_table;
    const Pose T = table_pose({});
    return T * rotation_about_y(canonical_yaw(T, T_world_sensor(0, states.front().travel)));
  }

  void make_header() {
    turntable = turntable_of(T_world_table.inverse() * T_world_sensor(0, states.front().travel));
    turntable.radius_m = options.platter.radius_m;
    if (states.size() > 1)
      turntable.speed_rad_s = (states.back().angle_rad - states.front().angle_rad) /
                              (states.back().time_s - states.front().time_s);
    for (const VirtualScanner& scanner : options.scanners)
      header.sensors.push_back(sensor_info(scanner));
    header.software = std::string("turnscan ") + version();
    header.source = "virtual scan";
    for (std::size_t i = 0; i < object_count; ++i)
      header.source += (i == 0 ? " of " : ", ") +
                       (turning[i].name.empty() ? std::string("object") : turning[i].name);
    if (options.record.calibration == RecordedCalibration::kNone) return;
    const Pose T_table_world = recorded_table().inverse();
    for (std::size_t k = 0; k < scanner_count(); ++k)
      header.sensors[k].T_table_sensor = T_table_world * T_world_sensor(k, states.front().travel);
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
      // The margin keeps rounding from calling the end of a turn the turn before.
      const double turns = std::abs(state.angle_rad) / kTurn + 1e-9;
      frame.turn = static_cast<std::uint32_t>(std::min(turns, 4e9));
      // A scanner that travels has a pose of its own in each frame.
      if (options.scanners[k].placement.travel_m != 0.0 &&
          options.record.calibration != RecordedCalibration::kNone)
        frame.T_table_sensor =
            rotation_about_y(-state.angle_rad) * T_table_world * T_world_sensor(k, state.travel);
      if (frame_dropped(options.motion, static_cast<std::uint64_t>(options.measure.seed),
                        instant_of(i), frame.sensor))
        frame.status = FrameStatus::kDropped;
    }
  }

  std::vector<Body> bodies_at(double angle_rad) const {
    std::vector<Body> bodies{{&*scene, T_world_platter(angle_rad)}};
    if (room) bodies.push_back({&*room, Pose::Identity()});
    return bodies;
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

  TrueSamples true_samples(std::size_t position) const {
    const std::size_t k = scanner_of(position);
    const PlatterState& state = state_of(position);
    const Pose T = T_world_sensor(k, state.travel);
    const std::vector<Body> bodies = bodies_at(state.angle_rad);
    TrueSamples out;
    out.scanner = static_cast<std::uint32_t>(k);
    tracers[k].trace(bodies, T, out.exact);
    noises[k].apply({tracers[k], bodies, T, albedo ? &albedo : nullptr}, out.exact,
                    instant_of(position), out.measured);
    out.hits.resize(out.exact.size());
    const PixelRect& rect = out.exact.rect;
    for (int row = rect.top; row < rect.bottom; ++row) {
      for (int column = rect.left; column < rect.right; ++column) {
        const std::size_t i = out.exact.index(column, row);
        if (out.exact.hit(i))
          out.hits[i] =
              tracers[k].hit_of(bodies, T, out.exact, i, tracers[k].direction(column, row));
      }
    }
    return out;
  }

  Frame render(std::size_t position, Workspace& space) const {
    const std::size_t k = scanner_of(position);
    const PlatterState& state = state_of(position);
    const Pose T = T_world_sensor(k, state.travel);
    const std::vector<Body> bodies = bodies_at(state.angle_rad);
    tracers[k].trace(bodies, T, space.exact);
    noises[k].apply({tracers[k], bodies, T, albedo ? &albedo : nullptr}, space.exact,
                    instant_of(position), space.measured);
    tallies[k].add(space.exact, space.measured);
    const sampling::Paint paint({turning, standing});
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
    if (color) frame.color = sampling::color_image(tracers[k], bodies, T, space.exact, paint);
    return frame;
  }
};

VirtualScan::VirtualScan(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VirtualScan::VirtualScan(VirtualScan&&) noexcept = default;
VirtualScan& VirtualScan::operator=(VirtualScan&&) noexcept = default;
VirtualScan::~VirtualScan() = default;

Result<VirtualScan> VirtualScan::create(std::vector<TriangleMesh> objects,
                                        const VirtualScanOptions& options) {
  TURNSCAN_TRY(check_options(options));
  TURNSCAN_ASSIGN(const NoiseOptions noise, noise_options(options.measure));
  TURNSCAN_ASSIGN(std::vector<PlatterState> states, platter_states(options.motion));
  auto impl = std::make_unique<Impl>(options, noise, std::move(states));
  impl->place(std::move(objects));
  TURNSCAN_TRY(impl->build_scenes());
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

std::span<const TriangleMesh> VirtualScan::objects() const {
  return std::span(impl_->turning).first(impl_->object_count);
}
const Scene& VirtualScan::scene() const { return *impl_->scene; }
const Scene* VirtualScan::room() const { return impl_->room ? &*impl_->room : nullptr; }
double VirtualScan::aim_height_m() const { return impl_->aim_height_m; }
const TurntableInfo& VirtualScan::turntable() const { return impl_->turntable; }
Pose VirtualScan::T_table_given() const { return rotation_about_y(-impl_->yaw_rad); }

Pose VirtualScan::T_table_sensor(std::size_t position) const {
  return impl_->T_table_sensor(position);
}

Pose VirtualScan::T_table_world(std::size_t position) const {
  return impl_->T_world_platter(impl_->state_of(position).angle_rad).inverse();
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
