#include <turnscan/io/import_scenes/scene_sensors.hpp>

#include <algorithm>
#include <cmath>

namespace turnscan::importers {

namespace {

constexpr double kSameCamera = 0.002;
constexpr std::size_t kMaxSceneSensors = 8;

bool same_scene_camera(const SensorInfo& a, const SensorInfo& b) {
  const CameraIntrinsics &p = a.intrinsics, &q = b.intrinsics;
  const double near = kSameCamera * p.width;
  return p.width == q.width && p.height == q.height && a.depth_unit_m == b.depth_unit_m &&
         p.distortion == q.distortion && std::abs(p.fx / q.fx - 1.0) <= kSameCamera &&
         std::abs(p.fy / q.fy - 1.0) <= kSameCamera && std::abs(p.cx - q.cx) <= near &&
         std::abs(p.cy - q.cy) <= near;
}

}  // namespace

Result<std::uint32_t> SceneSensors::number_of(const SensorInfo& sensor) {
  TURNSCAN_TRY(sensor.intrinsics.check());
  const auto at = std::find_if(sensors_.begin(), sensors_.end(),
                               [&](const SensorInfo& s) { return same_scene_camera(s, sensor); });
  const auto number = std::uint32_t(at - sensors_.begin());
  if (at != sensors_.end()) return number;
  if (number == kMaxSceneSensors)
    return fail(ErrorCode::kUnsupported,
                "the images have more than {} different cameras; a recording has one for each "
                "sensor",
                kMaxSceneSensors);
  sensors_.push_back(sensor);
  return number;
}

Result<> place_frames(const std::vector<std::optional<Pose>>& poses,
                      std::vector<ForeignFrame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].info.T_table_sensor = poses[i];
    if (const std::string why = implausible(frames[i].info); !why.empty())
      return fail(ErrorCode::kFormat, "frame {}: {}", frames[i].info.index, why);
  }
  return {};
}

}  // namespace turnscan::importers
