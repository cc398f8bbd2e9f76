#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/rays/scene.hpp>

#include "tests/support/rig.hpp"

namespace turnscan::testing {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 1e-4;

double between(std::uint64_t key, double low, double high) {
  return low + (high - low) * uniform01(key);
}

TriangleMesh box(const Vec3d& low, const Vec3d& high, double yaw = 0.0) {
  TriangleMesh mesh;
  const Vec3d middle = 0.5 * (low + high);
  for (int c = 0; c < 8; ++c) {
    const Vec3d p(c & 1 ? high.x() : low.x(), c & 2 ? high.y() : low.y(),
                  c & 4 ? high.z() : low.z());
    mesh.vertices.push_back((middle + rotation_about_y(yaw) * Vec3d(p - middle)).cast<float>());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Side of a cylinder about the y axis and, if wanted, its top.
TriangleMesh tube(const Vec3d& foot, double radius, double height, bool top) {
  constexpr std::uint32_t n = 96;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * kPi * i / n;
    for (const double y : {0.0, height})
      mesh.vertices.push_back(
          (foot + Vec3d(radius * std::sin(a), y, radius * std::cos(a))).cast<float>());
  }
  mesh.vertices.push_back((foot + Vec3d(0, height, 0)).cast<float>());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    if (top) mesh.triangles.push_back({a + 1, b + 1, 2 * n});
  }
  return mesh;
}

Pose camera_pose(const RigOptions& o) {
  const double c = std::cos(o.elevation_rad), s = std::sin(o.elevation_rad);
  Pose T = Pose::Identity();
  T.linear().col(0) = Vec3d(-1.0, 0.0, 0.0);
  T.linear().col(1) = Vec3d(0.0, -c, -s);
  T.linear().col(2) = Vec3d(0.0, -s, c);
  T.translation() = Vec3d(o.aim_x_m, o.aim_height_m, o.aim_z_m) - o.distance_m * T.linear().col(2);
  T.linear() = T.linear() * Eigen::AngleAxisd(o.roll_rad, Vec3d::UnitZ()).toRotationMatrix();
  return T;
}

CameraIntrinsics kinect_v2() {
  CameraIntrinsics camera;
  camera.width = 512, camera.height = 424;
  camera.fx = camera.fy = 365.5;
  camera.cx = 255.5, camera.cy = 211.5;
  return camera;
}

CameraIntrinsics camera_of(const RigOptions& o) {
  CameraIntrinsics camera = kinect_v2();
  camera.width /= o.shrink;
  camera.height /= o.shrink;
  camera.fx /= o.shrink;
  camera.fy /= o.shrink;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

std::vector<TriangleMesh> room_of(const RigOptions& o) {
  std::vector<TriangleMesh> out;
  if (!o.room) return out;
  out.push_back(box({-0.9, -o.desk_m - 0.03, -0.6}, {0.9, -o.desk_m, 0.7}, 0.1));
  out.push_back(box({-3.0, -1.0, 1.1}, {3.0, 2.0, 1.2}, between(hash_key(o.seed, 90), -0.3, 0.3)));
  if (o.drum) out.push_back(tube({0, -o.desk_m, 0}, o.radius_m, o.desk_m - 0.0002, false));
  for (int i = 0; i < o.clutter; ++i) {
    const auto random = [&](std::uint64_t k, double low, double high) {
      return between(hash_key(o.seed, 100 + std::uint64_t(i), k), low, high);
    };
    const double size = random(0, 0.02, 0.07), height = random(1, 0.03, 0.2);
    // Not where it stands between the camera and the whole platter.
    const double a = random(2, 0.25 * kPi, 1.75 * kPi) + kPi;
    const double far = o.radius_m + 1.5 * size + random(3, 0.02, 0.25);
    const Vec3d foot(far * std::sin(a), -o.desk_m, far * std::cos(a));
    if (i % 2 == 0)
      out.push_back(box(foot - Vec3d(size, 0, size), foot + Vec3d(size, height, 0.5 * size),
                        random(4, 0, kPi)));
    else
      out.push_back(tube(foot, 0.6 * size, height, true));
  }
  return out;
}

}  // namespace

struct Rig::Impl {
  RigOptions options;
  SequenceHeader header;
  std::vector<FrameInfo> frames;
  Pose T_table_sensor;
  Scene room, moving;
  RayTable rays;
  std::vector<float> room_depth;
  /// Every frame is rendered once: most stages read them several times.
  struct Rendered {
    std::once_flag once;
    DepthImage depth;
  };
  std::unique_ptr<Rendered[]> rendered;

  Impl(RigOptions o, Scene r, Scene m)
      : options(std::move(o)),
        T_table_sensor(camera_pose(options)),
        room(std::move(r)),
        moving(std::move(m)),
        rays(camera_of(options)) {
    SensorInfo sensor;
    sensor.intrinsics = camera_of(options);
    sensor.depth_unit_m = kUnit;
    header.sensors.push_back(sensor);
    for (int i = 0; i < options.frames; ++i) {
      FrameInfo frame;
      frame.index = std::uint32_t(i);
      frame.time_s = i / options.fps;
      frames.push_back(frame);
    }
    room_depth = trace(room, T_table_sensor, 0, 0, width(), height());
    rendered = std::make_unique<Rendered[]>(frames.size());
  }

  int width() const { return header.sensors[0].intrinsics.width; }
  int height() const { return header.sensors[0].intrinsics.height; }
  double angle(std::size_t i) const {
    return options.angle ? options.angle(frames[i].time_s) : 0.0;
  }

  /// Depth along z of the pixels of a rectangle; infinity where nothing is.
  std::vector<float> trace(const Scene& scene, const Pose& T, int left, int top, int right,
                           int bottom) const {
    std::vector<Ray> batch;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const auto i = std::size_t(y) * std::size_t(width()) + std::size_t(x);
        Ray ray;
        ray.origin = T.translation().cast<float>();
        ray.direction = (T.linear() * Vec3d(rays.x()[i], rays.y()[i], 1.0)).cast<float>();
        batch.push_back(ray);
      }
    }
    std::vector<RayHit> hits(batch.size());
    scene.intersect(batch, hits, RayOrder::kCoherent);
    std::vector<float> depth;
    for (const RayHit& hit : hits) depth.push_back(hit.t);
    return depth;
  }

  /// Room and object together.
  std::vector<float> depth_of(std::size_t position) const {
    std::vector<float> depth = room_depth;
    const Box box = moving.object_box();
    if (box.empty()) return depth;
    double reach = 0.0;
    for (const double x : {box.min.x(), box.max.x()})
      for (const double z : {box.min.z(), box.max.z()}) reach = std::max(reach, std::hypot(x, z));
    int left = width(), top = height(), right = 0, bottom = 0;
    for (int c = 0; c < 8; ++c) {
      const Vec3d corner(c & 1 ? reach : -reach, c & 2 ? box.max.y() : box.min.y(),
                         c & 4 ? reach : -reach);
      const auto uv = header.sensors[0].intrinsics.project(T_table_sensor.inverse() * corner);
      left = std::min(left, int(uv.x()) - 2), right = std::max(right, int(uv.x()) + 3);
      top = std::min(top, int(uv.y()) - 2), bottom = std::max(bottom, int(uv.y()) + 3);
    }
    left = std::max(left, 0), top = std::max(top, 0);
    right = std::min(right, width()), bottom = std::min(bottom, height());
    const auto part = trace(moving, rotation_about_y(-angle(position)) * T_table_sensor, left, top,
                            right, bottom);
    std::size_t k = 0;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x, ++k) {
        float& z = depth[std::size_t(y) * std::size_t(width()) + std::size_t(x)];
        z = std::min(z, part[k]);
      }
    }
    return depth;
  }

  double measured(const std::vector<float>& depth, int x, int y, std::uint64_t frame) const {
    const auto at = [&](int column, int row) {
      return depth[std::size_t(row) * std::size_t(width()) + std::size_t(column)];
    };
    const std::uint64_t key = hash_key(
        options.seed, 7, frame, std::uint64_t(y) * std::uint64_t(width()) + std::uint64_t(x));
    double z = at(x, y), step = 0.0;
    if (x > 0 && y > 0 && x + 1 < width() && y + 1 < height()) {
      for (const float there : {at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)}) {
        // On a surface seen at a low angle neighbouring rows lie far apart.
        if (there - z > 0.02) step = std::max(step, double(there) - z);
      }
      const double other =
          std::min(std::abs(double(at(x, y - 1)) - z), std::abs(double(at(x, y + 1)) - z));
      if (step < 1.5 * other) step = 0.0;
    }
    if (step > 0.0 && uniform01(mix64(key ^ 1)) < options.mixed_pixels)
      z += uniform01(mix64(key ^ 2)) * std::min(0.08, step);
    return z + options.noise_m * standard_normal(key);
  }

  DepthImage render(std::size_t position) const {
    const std::vector<float> depth = depth_of(position);
    DepthImage out(width(), height(), kNoReturn);
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        const auto i = std::size_t(y) * std::size_t(width()) + std::size_t(x);
        if (!(depth[i] < 6.0f)) continue;
        const double raw = std::round(measured(depth, x, y, position) / kUnit);
        if (raw >= 1.0 && raw < 65535.0) out.pixels[i] = static_cast<std::uint16_t>(raw);
      }
    }
    return out;
  }
};

RigOptions near_rig(int frames, double turns) {
  RigOptions o;
  o.shrink = 2;
  o.noise_m = 0.001;
  o.distance_m = 0.6;
  o.elevation_rad = 0.45;
  o.aim_height_m = 0.07;
  o.frames = frames;
  o.fps = 1.0;
  const double speed_rad_s = 2.0 * kPi * turns / frames;
  o.angle = [speed_rad_s](double t) { return speed_rad_s * t; };
  return o;
}

RigOptions random_rig(std::uint64_t seed) {
  const auto random = [&](std::uint64_t k, double low, double high) {
    return between(hash_key(seed, 55, k), low, high);
  };
  RigOptions o;
  o.seed = seed;
  o.distance_m = random(0, 0.6, 1.2);
  o.elevation_rad = random(1, 10.0, 50.0) * kPi / 180.0;
  o.radius_m = random(2, 0.10, 0.25);
  o.roll_rad = random(3, -10.0, 10.0) * kPi / 180.0;
  o.aim_height_m = random(4, 0.0, 0.08);
  o.aim_x_m = random(5, -0.04, 0.04);
  o.aim_z_m = random(6, -0.03, 0.03);
  o.desk_m = random(7, 0.015, 0.06);
  o.clutter = int(random(8, 2.0, 8.0));
  return o;
}

Rig::Rig(RigOptions options) {
  const auto platter =
      options.platter ? std::optional<double>(options.radius_m) : std::optional<double>();
  auto room = Scene::create(room_of(options), platter);
  auto moving = Scene::create(options.objects);
  impl_ = std::make_unique<Impl>(std::move(options), std::move(*room), std::move(*moving));
}
Rig::~Rig() = default;

const SequenceHeader& Rig::header() const { return impl_->header; }
const std::vector<FrameInfo>& Rig::frames() const { return impl_->frames; }
double Rig::true_angle(std::size_t position) const { return impl_->angle(position); }

TurntableInfo Rig::truth() const {
  const Pose T = impl_->T_table_sensor.inverse();
  TurntableInfo table;
  table.axis = T.linear() * Vec3d::UnitY();
  table.center_m = T.translation();
  table.radius_m = impl_->options.radius_m;
  return table;
}

Result<Frame> Rig::read(std::size_t position) const {
  Frame frame;
  frame.info = impl_->frames.at(position);
  Impl::Rendered& rendered = impl_->rendered[position];
  std::call_once(rendered.once, [&] { rendered.depth = impl_->render(position); });
  frame.depth = rendered.depth;
  return frame;
}

}  // namespace turnscan::testing
