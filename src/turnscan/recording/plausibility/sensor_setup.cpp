#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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

}  // namespace turnscan::plausibility
