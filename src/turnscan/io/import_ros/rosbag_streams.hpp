#pragma once
// Finds the depth and colour images of a ROS bag: topics, cameras, unit, poses.

#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/io/rosbag/bag_file.hpp>
#include <vector>

namespace turnscan::importers {

struct BagStreams {
  std::string origin;  ///< human-readable
  SensorInfo sensor;   ///< complete except for its pose relative to the table
  std::string depth_topic;
  bool depth_compressed = false;
  std::string color_topic;  ///< empty: none
  bool color_compressed = false;
  std::vector<std::string> notes;  ///< assumptions and omissions
};

/// Whether librealsense's recorder wrote the bag.
bool is_realsense(const rosbag::Bag& bag);

/// Follows librealsense's src/media/ros/ros_file_format.h: topics /device_D/sensor_S/Depth_N/...
/// with image/data, info/camera_info and tf/REFERENCE, /device_D/info and
/// /device_D/sensor_S/option/Depth_Units/value (older ones: Depth Units). Fails with kMissingData
/// if there is no depth stream, kInvalidOption for a topic that is not one, kUnsupported and
/// kFormat.
Result<BagStreams> realsense_streams(const rosbag::Bag& bag, const ImportOptions& options);

/// Images with an accompanying camera_info (REP 118), and transforms in /tf_static and /tf. Fails
/// with kInvalidOption if several topics contain depth and none is chosen, kMissingData if there is
/// none or the camera is not known, and as above.
Result<BagStreams> ros_streams(const rosbag::Bag& bag, const ImportOptions& options);

/// The first message of a topic. Fails with kMissingData if there is none, and as Bag::read().
Result<rosbag::Payload> first_message(const rosbag::Bag& bag, std::string_view topic);

}  // namespace turnscan::importers
