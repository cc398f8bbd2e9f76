#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/simulator/pinhole_tracer.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

namespace turnscan {

namespace {

constexpr double kDepthUnit_m = 1e-4;
constexpr std::uint64_t kSensor = 0;
constexpr Rgb kPlatterColor{72, 74, 78};
constexpr Rgb kEmptyColor{28, 30, 34};

// Independent random numbers of one pixel; the noise takes the pixel's key itself.
constexpr std::uint64_t kChoiceSalt = 0x6d69786564ULL;
constexpr std::uint64_t kReachSalt = 0x7265616368ULL;

Pose camera_pose(const VirtualScanOptions& o) {
  const double c = std::cos(o.elevation_rad), s = std::sin(o.elevation_rad);
  Pose T = Pose::Identity();
  T.linear().col(0) = Vec3d(-1.0, 0.0, 0.0);
  T.linear().col(1) = Vec3d(0.0, -c, -s);
  T.linear().col(2) = Vec3d(0.0, -s, c);
  T.translation() = Vec3d(0.0, o.aim_height_m, 0.0) - o.distance_m * T.linear().col(2);
  return T;
}

Rgb shaded(const Vec3f& albedo, float light) {
  const Vec3f c = (light * albedo).cwiseMin(255.0f).cwiseMax(0.0f) + Vec3f::Constant(0.5f);
  return {std::uint8_t(c.x()), std::uint8_t(c.y()), std::uint8_t(c.z())};
}

Vec3f as_vector(Rgb c) { return {float(c.r), float(c.g), float(c.b)}; }

}  // namespace

CameraIntrinsics intrinsics_of(ScannerPreset preset) {
  CameraIntrinsics camera;
  if (preset == ScannerPreset::kKinectV2) {
    camera.width = 512, camera.height = 424;
    camera.fx = camera.fy = 365.5;
  } else {
    camera.width = camera.height = 640;
    camera.fx = camera.fy = 700.0;
  }
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

OptionTable describe(VirtualScanOptions& o) {
  constexpr double kRight = std::numbers::pi / 2;
  OptionTable table;
  table
      .choice("scanner", o.scanner, {"kinect-v2", "ideal"},
              "The virtual scanner: kinect-v2 (512 x 424) or ideal (640 x 640, finer).")
      .number("distance", o.distance_m, Quantity::kLength, {0.01, 100.0},
              "Distance of the scanner from the point it looks at.")
      .number("elevation", o.elevation_rad, Quantity::kAngle, {-0.99 * kRight, 0.99 * kRight},
              "Height of the scanner above the horizontal, as an angle.")
      .number("aim-height", o.aim_height_m, Quantity::kLength, {-10.0, 10.0},
              "Height above the platter of the point on the axis that the scanner looks at.")
      .number("frames", o.frames, {1, 1000000}, "Number of depth images.")
      .number("turns", o.turns, Quantity::kNone, {-1000.0, 1000.0},
              "Turns of the platter that the frames are spread over.")
      .number("fps", o.fps, Quantity::kNone, {1e-3, 1e6}, "Frames a second.")
      .number("scan-speed", o.speed_rad_s, Quantity::kAngularSpeed, {-1000.0, 1000.0},
              "Speed of the platter; auto: from turns, frames and fps.")
      .text("noise", o.noise, "Depth noise: none or gaussian:SIGMA, e.g. gaussian:1.5mm.")
      .number("mixed-pixels", o.mixed_pixels, Quantity::kNone, {0.0, 1.0},
              "Share of the silhouette's pixels that return a depth between edge and background.")
      .number("mixed-reach", o.mixed_reach_m, Quantity::kLength, {0.0, 10.0},
              "How far behind the edge a mixed pixel may lie.")
      .number("seed", o.seed, {0, 2147483647}, "Seed of all random numbers.")
      .flag("platter", o.platter, "Whether the scanner sees the platter.")
      .number("platter-radius", o.platter_radius_m, Quantity::kLength, {1e-3, 10.0},
              "Radius of the platter.")
      .flag("scan-colour", o.color, "Also give a colour image with each depth image.");
  return table;
}

Result<double> parse_noise(std::string_view text) {
  constexpr std::string_view kGaussian = "gaussian:";
  if (text == "none") return 0.0;
  if (!text.starts_with(kGaussian))
    return fail(ErrorCode::kInvalidOption,
                "noise = {} is not known; write none or gaussian:SIGMA, e.g. gaussian:1.5mm", text);
  const auto sigma = parse_quantity(text.substr(kGaussian.size()), Quantity::kLength);
  if (!sigma) return fail(ErrorCode::kInvalidOption, "noise: {}", sigma.error().message);
  if (!(*sigma >= 0.0 && *sigma <= 1.0))
    return fail(ErrorCode::kInvalidOption, "noise = {} is outside gaussian:0mm to gaussian:1000mm",
                text);
  return *sigma;
}

struct VirtualScan::Impl {
  VirtualScanOptions options;
  double sigma_m = 0.0;
  std::vector<TriangleMesh> objects;
  Scene scene;
  SequenceHeader header;
  std::vector<FrameInfo> frames;
  PinholeTracer tracer;

  Impl(const VirtualScanOptions& o, double sigma, std::vector<TriangleMesh> meshes, Scene s)
      : options(o),
        sigma_m(sigma),
        objects(std::move(meshes)),
        scene(std::move(s)),
        header(make_header()),
        tracer(camera()) {
    make_frames();
  }

  const CameraIntrinsics& camera() const { return header.sensors[0].intrinsics; }

  double step_rad() const {
    return options.speed_rad_s ? *options.speed_rad_s / options.fps
                               : 2.0 * std::numbers::pi * options.turns / options.frames;
  }

  SequenceHeader make_header() const {
    SequenceHeader out;
    SensorInfo sensor;
    sensor.model = options.scanner == ScannerPreset::kKinectV2 ? "virtual kinect-v2" : "virtual";
    sensor.intrinsics = options.intrinsics.value_or(intrinsics_of(options.scanner));
    sensor.depth_unit_m = kDepthUnit_m;
    sensor.T_table_sensor = camera_pose(options);
    const Pose T_sensor_table = sensor.T_table_sensor->inverse();
    TurntableInfo table;
    table.axis = T_sensor_table.linear() * Vec3d::UnitY();
    table.center_m = T_sensor_table.translation();
    table.radius_m = options.platter_radius_m;
    table.speed_rad_s = step_rad() * options.fps;
    out.sensors.push_back(std::move(sensor));
    out.turntable = table;
    out.software = std::string("turnscan ") + version();
    out.source = "virtual scan";
    for (std::size_t i = 0; i < objects.size(); ++i)
      out.source += (i == 0 ? " of " : ", ") +
                    (objects[i].name.empty() ? std::string("object") : objects[i].name);
    return out;
  }

  void make_frames() {
    frames.resize(static_cast<std::size_t>(options.frames));
    for (std::uint32_t i = 0; i < frames.size(); ++i) {
      const double angle = step_rad() * i;
      frames[i].index = i;
      frames[i].time_s = i / options.fps;
      frames[i].angle_rad = angle;
      // The margin keeps rounding from calling the end of a turn the turn before.
      const double turns = std::abs(angle) / (2.0 * std::numbers::pi) + 1e-9;
      frames[i].turn = static_cast<std::uint32_t>(std::min(turns, 4e9));
    }
  }

  Pose T_table_sensor(std::size_t i) const {
    return rotation_about_y(-*frames[i].angle_rad) * *header.sensors[0].T_table_sensor;
  }

  /// How far behind the pixel the deepest of its neighbours lies, 0 if it is no silhouette pixel.
  double silhouette_step(const Sight& sight, int column, int row) const {
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    const RayHit& here = *sight.at(column, row);
    double step = 0.0;
    const auto look = [&](int x, int y) {
      if (x < 0 || y < 0 || x >= camera().width || y >= camera().height) return;
      const RayHit* there = sight.at(x, y);
      if (there == nullptr || !there->valid()) {
        step = kEndless;
      } else if (there->object != kPlatter || here.object != kPlatter) {
        const double behind = double(there->t) - double(here.t);
        if (behind > kSilhouetteStep_m) step = std::max(step, behind);
      }
    };
    look(column - 1, row);
    look(column + 1, row);
    look(column, row - 1);
    look(column, row + 1);
    return step;
  }

  double measured_depth(const Sight& sight, int column, int row, std::uint32_t frame) const {
    const std::uint64_t pixel = std::uint64_t(row) * std::uint64_t(camera().width) + column;
    const std::uint64_t key =
        hash_key(static_cast<std::uint64_t>(options.seed), kSensor, frame, pixel);
    double z = sight.at(column, row)->t;
    const double step = silhouette_step(sight, column, row);
    if (step > 0.0 && uniform01(mix64(key ^ kChoiceSalt)) < options.mixed_pixels)
      z += uniform01(mix64(key ^ kReachSalt)) * std::min(options.mixed_reach_m, step);
    if (sigma_m > 0.0) z += sigma_m * standard_normal(key);
    return z;
  }

  DepthImage depth_of(const Sight& sight, std::uint32_t frame) const {
    DepthImage depth(camera().width, camera().height, kNoReturn);
    for (int y = sight.rect.top; y < sight.rect.bottom; ++y) {
      for (int x = sight.rect.left; x < sight.rect.right; ++x) {
        if (!sight.at(x, y)->valid()) continue;
        const double raw = std::round(measured_depth(sight, x, y, frame) / kDepthUnit_m);
        if (raw >= 1.0 && raw < double(kOutsideCrop))
          depth.at(x, y) = static_cast<std::uint16_t>(raw);
      }
    }
    return depth;
  }

  Vec3f albedo(const RayHit& hit) const {
    if (hit.object == kPlatter) return as_vector(kPlatterColor);
    const TriangleMesh& mesh = objects[hit.object];
    if (mesh.colors.size() != mesh.vertices.size()) return Vec3f::Constant(190.0f);
    const auto& t = mesh.triangles[hit.triangle];
    return (1.0f - hit.u - hit.v) * as_vector(mesh.colors[t[0]]) +
           hit.u * as_vector(mesh.colors[t[1]]) + hit.v * as_vector(mesh.colors[t[2]]);
  }

  /// Lit from the camera.
  ColorImage color_of(const Sight& sight, const Pose& T) const {
    ColorImage image(camera().width, camera().height, kEmptyColor);
    for (int y = sight.rect.top; y < sight.rect.bottom; ++y) {
      for (int x = sight.rect.left; x < sight.rect.right; ++x) {
        const RayHit& hit = *sight.at(x, y);
        if (!hit.valid()) continue;
        const float facing = std::abs(hit.normal.dot(tracer.ray(x, y, T).direction.normalized()));
        image.at(x, y) = shaded(albedo(hit), 0.35f + 0.65f * facing);
      }
    }
    return image;
  }
};

VirtualScan::VirtualScan(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VirtualScan::VirtualScan(VirtualScan&&) noexcept = default;
VirtualScan& VirtualScan::operator=(VirtualScan&&) noexcept = default;
VirtualScan::~VirtualScan() = default;

Result<VirtualScan> VirtualScan::create(std::vector<TriangleMesh> objects,
                                        const VirtualScanOptions& options) {
  VirtualScanOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  if (options.intrinsics) TURNSCAN_TRY(options.intrinsics->check());
  TURNSCAN_ASSIGN(const double sigma, parse_noise(options.noise));
  std::optional<double> platter;
  if (options.platter) platter = options.platter_radius_m;
  TURNSCAN_ASSIGN(Scene scene, Scene::create(objects, platter));
  return VirtualScan(std::make_unique<Impl>(options, sigma, std::move(objects), std::move(scene)));
}

const SequenceHeader& VirtualScan::header() const { return impl_->header; }
const std::vector<FrameInfo>& VirtualScan::frames() const { return impl_->frames; }
const std::vector<TriangleMesh>& VirtualScan::objects() const { return impl_->objects; }
const Scene& VirtualScan::scene() const { return impl_->scene; }

Pose VirtualScan::T_table_sensor(std::size_t position) const {
  return impl_->T_table_sensor(position);
}

Result<Frame> VirtualScan::read(std::size_t position) const {
  if (position >= impl_->frames.size())
    return fail(ErrorCode::kNotFound, "virtual scan: there is no frame {}, only {}", position,
                impl_->frames.size());
  const Pose T = impl_->T_table_sensor(position);
  const Sight sight = impl_->tracer.trace(impl_->scene, T);
  Frame frame;
  frame.info = impl_->frames[position];
  frame.depth = impl_->depth_of(sight, frame.info.index);
  if (impl_->options.color) frame.color = impl_->color_of(sight, T);
  return frame;
}

}  // namespace turnscan
