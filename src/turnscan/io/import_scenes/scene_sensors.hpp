#pragma once
// Cameras of data sets that state one for each image.

#include <turnscan/io/import/importers_common.hpp>
#include <vector>

namespace turnscan::importers {

/// Collects the sensors of a data set: images share one if their cameras differ by at most what an
/// autofocus changes (0.2 % of the focal length and of the width).
class SceneSensors {
 public:
  /// The number of the camera's sensor. Fails with kUnsupported beyond a few, and with kFormat if
  /// the camera is not usable.
  Result<std::uint32_t> number_of(const SensorInfo& sensor);
  std::vector<SensorInfo> take() { return std::move(sensors_); }

 private:
  std::vector<SensorInfo> sensors_;
};

/// Places each frame at its pose in the data set's world (nullopt: not known), once
/// settle_device_poses() or placed_pose() has turned it upright. Fails with kFormat for a pose that
/// cannot be.
Result<> place_frames(const std::vector<std::optional<Pose>>& poses,
                      std::vector<ForeignFrame>& frames);

}  // namespace turnscan::importers
