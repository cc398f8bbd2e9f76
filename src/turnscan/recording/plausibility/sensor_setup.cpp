#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/median.hpp>
#include <turnscan/recording/plausibility/finders.hpp>

namespace turnscan::plausibility {

namespace {

/// Lenses lie within a few percent of their images' middles; half or three quarters of the size are
/// the nearest other resolutions.
constexpr double kOtherSize = 0.2;
constexpr float kMargin = 0.05f;  ///< of the scan's box

bool is_within(const Vec3f& viewpoint, const std::vector<Vec3f>& points) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& p : points) box.extend(p);
  const Vec3f margin = kMargin * box.sizes();
  return !box.isEmpty() && (viewpoint - box.min() - margin).minCoeff() > 0.0f &&
         (box.max() - viewpoint - margin).minCoeff() > 0.0f;
}

}  // namespace

void look_at_intrinsics(std::size_t number, const SensorInfo& sensor, Findings& out) {
  if (sensor.kind != SensorKind::kDepthCamera) return;
  const CameraIntrinsics& c = sensor.intrinsics;
  const double across = 2.0 * c.cx / c.width - 1.0, along = 2.0 * c.cy / c.height - 1.0;
  if (!(std::abs(across) > kOtherSize) || !(std::abs(along) > kOtherSize)) return;
  const bool resolution = across * along > 0.0;
  std::string text = fmt::format(
      "the principal point of sensor {}, {:.0f}, {:.0f}, is far from the middle of its images of "
      "{} x {} pixels: ",
      number, c.cx, c.cy, c.width, c.height);
  text += resolution
              ? fmt::format(
                    "the intrinsics are of images of about {:.0f} x {:.0f} pixels; state "
                    "those of these, --intrinsics fx,fy,cx,cy",
                    2.0 * c.cx, 2.0 * c.cy)
              : std::string("the images are cut out of larger ones, or the intrinsics are wrong");
  out.push_back({resolution ? Plausibility::kImplausible : Plausibility::kDoubtful, std::move(text),
                 resolution ? "intrinsics" : ""});
}

void look_at_viewpoint(std::size_t number, const SensorInfo& sensor,
                       const std::vector<Frame>& frames, Findings& out) {
  if (sensor.kind == SensorKind::kDepthCamera || sensor.viewpoint.parallel) return;
  const Vec3f viewpoint = sensor.viewpoint.value.cast<float>();
  const auto inside = std::count_if(frames.begin(), frames.end(), [&](const Frame& frame) {
    return is_within(viewpoint, frame.points.points);
  });
  if (2 * std::size_t(inside) <= frames.size()) return;
  out.push_back(
      {Plausibility::kImplausible,
       fmt::format("the scans lie around the place of sensor {}, where the scanner cannot "
                   "have stood; say where it stood, --sensor-position x,y,z, or from "
                   "which side it looked, --sensor-direction x,y,z",
                   number),
       "sensor-position"});
}

void look_at_poses(std::size_t number, const SensorInfo& sensor, const std::vector<Frame>& frames,
                   Findings& out) {
  if (sensor.kind != SensorKind::kDepthCamera) return;
  constexpr double kTurned = 0.5;  // radians: at least so far, they look at something from around
  constexpr double kOnTheSpot = 0.1;  // of the distance that such a turn spans
  constexpr double kMeet = 0.25;      // of the distance: how near the lines of sight pass
  std::vector<Pose> poses;
  for (const Frame& frame : frames)
    if (frame.info.T_table_sensor) poses.push_back(*frame.info.T_table_sensor);
  double turned = 0.0, apart_m = 0.0;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vec3d right = Vec3d::Zero();
  const auto across = [](const Pose& pose) {
    const Vec3d sight = pose.linear().col(2);
    return Eigen::Matrix3d(Eigen::Matrix3d::Identity() - sight * sight.transpose());
  };
  for (const Pose& pose : poses) {
    const double cosine = pose.linear().col(2).dot(poses.front().linear().col(2));
    turned = std::max(turned, std::acos(std::clamp(cosine, -1.0, 1.0)));
    apart_m = std::max(apart_m, (pose.translation() - poses.front().translation()).norm());
    sum += across(pose);
    right += across(pose) * pose.translation();
  }
  if (turned < kTurned) return;
  const Vec3d meeting = sum.ldlt().solve(right);
  double nearest_m = std::numeric_limits<double>::max(), farthest_m = -nearest_m, off_m = 0.0;
  for (const Pose& pose : poses) {
    const double ahead_m = pose.linear().col(2).dot(meeting - pose.translation());
    nearest_m = std::min(nearest_m, ahead_m);
    farthest_m = std::max(farthest_m, ahead_m);
    off_m = std::max(off_m, (across(pose) * (meeting - pose.translation())).norm());
  }
  std::vector<double> depths;
  for (const std::uint16_t raw : frames.front().depth.pixels)
    if (raw != kNoReturn && raw != kOutsideCrop) depths.push_back(raw * sensor.depth_unit_m);
  if (depths.empty()) return;
  const double seen_m = median(depths);
  const char* what = nullptr;
  if (apart_m < kOnTheSpot * turned * seen_m)
    what =
        "turn on the spot, though the images show an object from around: they are probably the "
        "inverse of what the layout has";
  else if (farthest_m < 0.0 && off_m < -kMeet * farthest_m)
    what =
        "look away from the place that they go round: their z points backward, or they are the "
        "inverse of what the layout has";
  if (what != nullptr) {
    out.push_back({Plausibility::kImplausible,
                   fmt::format("the poses of sensor {} {} (--pose-direction, or the axes of its "
                               "cameras)",
                               number, what),
                   ""});
    return;
  }
  if (nearest_m > 0.0 && off_m < kMeet * nearest_m)
    look_at_distance(sensor, 0.5 * (nearest_m + farthest_m), "the lines of sight of the poses meet",
                     frames, out);
}

}  // namespace turnscan::plausibility
