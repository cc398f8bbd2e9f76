#include <numbers>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/units.hpp>

namespace turnscan {

std::string implausible(const FrameInfo& info) {
  constexpr double kMaxTime_s = 1e13, kMaxTurns = 1e6;
  if (std::isinf(info.time_s) || std::abs(info.time_s) > kMaxTime_s)
    return fmt::format("its time {:.3g} s is beyond {:.0e} s", info.time_s, kMaxTime_s);
  if (info.angle_rad && !(std::abs(*info.angle_rad) <= kMaxTurns * 2.0 * std::numbers::pi))
    return fmt::format("its angle {:.3g} rad is beyond {:.0e} turns", *info.angle_rad, kMaxTurns);
  if (info.T_table_sensor && (!info.T_table_sensor->matrix().allFinite() ||
                              info.T_table_sensor->translation().norm() > kMaxDistance_m))
    return fmt::format("its pose lies beyond {:.0f} km", kMaxDistance_m / 1000.0);
  return {};
}

Vec3d Viewpoint::direction_from(const Vec3d& p) const {
  if (parallel) return value;
  const Vec3d d = value - p;
  const double length = d.norm();
  return length > 0.0 ? Vec3d(d / length) : Vec3d::Zero();
}

Viewpoint Viewpoint::transformed(const Pose& T_to_from) const {
  if (parallel) return {T_to_from.linear() * value, true};
  return {T_to_from * value, false};
}

namespace {

void look_up_color(const ColorImage& image, const SensorInfo& sensor, PointCloud& cloud) {
  const CameraIntrinsics& camera = *sensor.color_intrinsics;
  cloud.colors.reserve(cloud.size());
  for (const Vec3f& p : cloud.points) {
    const Vec3d q = sensor.T_color_sensor * p.cast<double>();
    Rgb color;
    if (q.z() > 0.0) {
      const Eigen::Vector2d uv = camera.project(q);
      const double u = std::round(uv.x()), v = std::round(uv.y());
      if (u >= 0 && v >= 0 && u < image.width && v < image.height)
        color = image.at(static_cast<int>(u), static_cast<int>(v));
    }
    cloud.colors.push_back(color);
  }
}

Result<FramePoints> points_of_depth(const Frame& frame, const SensorInfo& sensor,
                                    const RayTable& rays) {
  const DepthImage& depth = frame.depth;
  const std::size_t n = depth.pixels.size();
  if (depth.width != sensor.intrinsics.width || depth.height != sensor.intrinsics.height ||
      rays.x().size() != n)
    return fail_at(frame.info.file, ErrorCode::kFormat,
                   "depth image is {} x {} pixels, but its sensor has {} x {}", depth.width,
                   depth.height, sensor.intrinsics.width, sensor.intrinsics.height);
  const bool registered = !sensor.color_intrinsics && frame.color.width == depth.width &&
                          frame.color.height == depth.height;
  FramePoints out;
  out.width = depth.width;
  out.height = depth.height;
  out.viewpoint = sensor.viewpoint;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint16_t raw = depth.pixels[i];
    if (raw == kNoReturn || raw == kOutsideCrop) continue;
    const float z = static_cast<float>(raw * sensor.depth_unit_m + sensor.depth_bias_m);
    const Vec3f p(rays.x()[i] * z, rays.y()[i] * z, z);
    if (!(z > 0.0f) || !p.allFinite()) continue;
    out.cloud.points.push_back(p);
    out.cell.push_back(static_cast<std::int32_t>(i));
    if (registered) out.cloud.colors.push_back(frame.color.pixels[i]);
  }
  if (sensor.color_intrinsics && !frame.color.empty())
    look_up_color(frame.color, sensor, out.cloud);
  return out;
}

Result<FramePoints> points_of_scan(const Frame& frame, const SensorInfo& sensor) {
  const PointCloud& in = frame.points;
  const bool colored = in.colors.size() == in.size();
  FramePoints out;
  out.viewpoint = sensor.viewpoint;
  const auto take = [&](std::size_t i) {
    if (!in.points[i].allFinite()) return false;
    out.cloud.points.push_back(in.points[i]);
    if (colored) out.cloud.colors.push_back(in.colors[i]);
    return true;
  };
  if (frame.grid.empty()) {
    for (std::size_t i = 0; i < in.size(); ++i) take(i);
    return out;
  }
  if (frame.grid_width < 0 || frame.grid_height < 0 ||
      frame.grid.size() != std::size_t(frame.grid_width) * std::size_t(frame.grid_height))
    return fail_at(frame.info.file, ErrorCode::kFormat, "range grid has {} cells, not {} x {}",
                   frame.grid.size(), frame.grid_width, frame.grid_height);
  out.width = frame.grid_width;
  out.height = frame.grid_height;
  for (std::size_t c = 0; c < frame.grid.size(); ++c) {
    const std::int32_t i = frame.grid[c];
    if (i < 0) continue;
    if (std::size_t(i) >= in.size())
      return fail_at(frame.info.file, ErrorCode::kFormat,
                     "range grid names point {}, but there are {}", i, in.size());
    if (take(std::size_t(i))) out.cell.push_back(static_cast<std::int32_t>(c));
  }
  return out;
}

}  // namespace

Result<FramePoints> points_of(const Frame& frame, const SensorInfo& sensor, const RayTable& rays) {
  if (!frame.depth.empty()) return points_of_depth(frame, sensor, rays);
  return points_of_scan(frame, sensor);
}

}  // namespace turnscan
