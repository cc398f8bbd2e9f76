#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tests/reconstruction/turning_scan.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan::testing {

double to_ball(const Vec3d& o, const Vec3d& d, const Vec3d& center, double radius) {
  const Vec3d m = o - center;
  const double a = d.squaredNorm(), b = m.dot(d);
  const double q = b * b - a * (m.squaredNorm() - radius * radius);
  const double t = (-b - std::sqrt(std::max(0.0, q))) / a;
  return q > 0.0 && t > 0.0 ? t : 0.0;
}

double to_box(const Vec3d& o, const Vec3d& d, const Vec3d& low, const Vec3d& high) {
  double in = 0.0, out = 1e9;
  for (int a = 0; a < 3; ++a) {
    const double p = (low[a] - o[a]) / d[a], q = (high[a] - o[a]) / d[a];
    in = std::max(in, std::min(p, q));
    out = std::min(out, std::max(p, q));
  }
  return in < out ? in : 0.0;
}

double nearer(double a, double b) { return a > 0.0 && (b == 0.0 || a < b) ? a : b; }

MemorySequence scan(const Trace& things, const Rig& rig) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.intrinsics.width = 160, sensor.intrinsics.height = 120;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 260.0;
  sensor.intrinsics.cx = 79.5, sensor.intrinsics.cy = 59.5;
  const double up = 25.0 * std::numbers::pi / 180.0;
  const Vec3d aim(0, 0.04, 0);
  const Vec3d eye = aim + 0.6 * Vec3d(0, std::sin(up), -std::cos(up));
  const Vec3d z = (aim - eye).normalized(), x = z.cross(Vec3d::UnitY()).normalized();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = x;
  pose.linear().col(1) = z.cross(x);
  pose.linear().col(2) = z;
  pose.translation() = eye;
  sensor.T_table_sensor = pose;
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.axis = pose.linear().transpose() * Vec3d::UnitY();
  table.center_m = pose.inverse() * Vec3d::Zero();
  table.radius_m = 0.12;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < std::uint32_t(rig.frames); ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = 2.0 * std::numbers::pi * f / rig.frames;
    if (uniform01(hash_key(rig.seed, f, 77)) < rig.dropped)
      frame.info.status = FrameStatus::kDropped;
    const Pose view = rotation_about_y(-*frame.info.angle_rad) * pose;
    frame.depth = DepthImage(160, 120);
    std::vector<double> depth(160 * 120, 0.0);
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const Vec3d ray = sensor.intrinsics.ray(u, v);
        const Vec3d d = view.linear() * ray;
        double t = things(view.translation(), d);
        const double floor = -view.translation().y() / d.y();
        const Vec3d hit = view.translation() + floor * d;
        if (rig.platter && floor > 0.0 && std::hypot(hit.x(), hit.z()) < 0.12) t = nearer(floor, t);
        depth[std::size_t(v * 160 + u)] = t;
      }
    }
    for (int i = 0; i < 160 * 120; ++i) {
      double t = depth[std::size_t(i)];
      if (t == 0.0) continue;
      const int u = i % 160;
      const double beside = u + 1 < 160 ? depth[std::size_t(i + 1)] : 0.0;
      const bool edge = beside == 0.0 || beside > t + 0.02;
      const std::uint64_t key = hash_key(rig.seed, f, std::uint64_t(i));
      if (edge && uniform01(hash_key(key, 1, 0)) < rig.flying)
        t += 0.08 * uniform01(hash_key(key, 2, 0));
      t += rig.noise_m * standard_normal(hash_key(key, 3, 0));
      frame.depth.pixels[std::size_t(i)] = std::uint16_t(std::lround(t * 1e4));
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

MemorySequence line_scan(const Trace& things) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.kind = SensorKind::kPointScanner;
  Pose pose = Pose::Identity();
  pose.linear().col(0) = -Vec3d::UnitX();
  pose.linear().col(1) = -Vec3d::UnitY();
  pose.translation() = Vec3d(0, 0.1, -0.4);
  sensor.T_table_sensor = pose;
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.axis = -Vec3d::UnitY();
  table.center_m = Vec3d(0, 0.1, 0.4);
  table.radius_m = 0.12;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < 120; ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = 2.0 * std::numbers::pi * f / 120;
    const Pose view = rotation_about_y(-*frame.info.angle_rad) * pose;
    for (int i = 0; i < 300; ++i) {
      const Vec3d ray(0, 0.0015 * ((i * 7) % 300 - 150), 1);
      const double t = things(view.translation(), view.linear() * ray);
      if (t > 0.0) frame.points.points.push_back((t * ray).cast<float>());
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

std::vector<views::DepthView> views_of(const MemorySequence& sequence) {
  const SensorInfo& sensor = sequence.header().sensors[0];
  const RayTable rays(sensor.intrinsics);
  std::vector<views::DepthView> views;
  for (std::size_t f = 0; f < sequence.frames().size(); ++f) {
    const Pose pose = rotation_about_y(-*sequence.frames()[f].angle_rad) * *sensor.T_table_sensor;
    auto view = views::make_view(*sequence.read(f), sensor, rays, pose, {}, [&](const Vec3f& p) {
      return (pose * p.cast<double>()).y() > 0.005;
    });
    EXPECT_TRUE(view) << view.error().text();
    if (view) views.push_back(std::move(*view));
  }
  return views;
}

double ball(const Vec3d& o, const Vec3d& d) {
  return nearer(to_ball(o, d, kCenter, kRadius), to_box(o, d, kCenter - Vec3d(0.015, 0.05, 0.015),
                                                        kCenter + Vec3d(0.015, 0, 0.015)));
}

double median_error_to_ball(const TriangleMesh& mesh) {
  std::vector<double> errors;
  for (const Vec3f& v : mesh.vertices) {
    if (v.y() > kCenter.y())
      errors.push_back(std::abs((v.cast<double>() - kCenter).norm() - kRadius));
  }
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

::testing::AssertionResult is_solid(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;
  std::vector<std::map<std::uint32_t, std::uint32_t>> around(mesh.vertices.size());
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (++runs[{t[c], t[(c + 1) % 3]}] > 1) return ::testing::AssertionFailure() << "edge twice";
      around[t[c]][t[(c + 1) % 3]] = t[(c + 2) % 3];
    }
    volume += mesh.vertices[t[0]].cast<double>().dot(
        mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>()));
  }
  for (const auto& [edge, count] : runs) {
    if (runs.count({edge.second, edge.first}) == 0)
      return ::testing::AssertionFailure() << "open edge";
  }
  for (const auto& next : around) {
    if (next.empty()) continue;
    std::uint32_t v = next.begin()->first;
    std::size_t steps = 0;
    do {
      v = next.at(v);
      ++steps;
    } while (v != next.begin()->first && steps <= next.size());
    if (steps != next.size()) return ::testing::AssertionFailure() << "two fans at a vertex";
  }
  if (!(volume > 0.0)) return ::testing::AssertionFailure() << "not outward";
  return ::testing::AssertionSuccess();
}

ReconstructOptions volumetric() {
  ReconstructOptions options;
  options.surface.method = SurfaceMethod::kVolumetric;
  return options;
}

}  // namespace turnscan::testing
