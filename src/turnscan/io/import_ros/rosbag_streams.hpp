#pragma once
// What a ROS bag says about its depth and colour images: topics, cameras, unit, places.

#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/io/rosbag/bag_file.hpp>
#include <vector>

namespace turnscan::importers {

struct BagStreams {
  std::string origin;  ///< for people
  SensorInfo sensor;   ///< complete but for the table
  std::string depth_topic;
  bool depth_compressed = false;
  std::string color_topic;  ///< empty: none
  bool color_compressed = false;
  std::vector<std::string> notes;  ///< what was assumed or left out
};

/// Whether librealsense's recorder wrote the bag.
bool is_realsense(const rosbag::Bag& bag);

/// After librealsense's src/media/ros/ros_file_format.h: topics /device_D/sensor_S/Depth_N/... with
/// image/data, info/camera_info and tf/REFERENCE, /device_D/info and
/// /device_D/sensor_S/option/Depth_Units/value (older ones: Depth Units). Fails with kMissingData
/// without a depth stream, kInvalidOption for a topic that is none, kUnsupported and kFormat.
Result<BagStreams> realsense_streams(const rosbag::Bag& bag, const ImportOptions& options);

/// Images with a camera_info beside them (REP 118), and transforms in /tf_static and /tf. Fails
/// with kInvalidOption where several topics hold depth and none is stated, kMissingData where none
/// does or the camera is not known, and as above.
Result<BagStreams> ros_streams(const rosbag::Bag& bag, const ImportOptions& options);

/// The first message of a topic. Fails with kMissingData where there is none, and as Bag::read().
Result<rosbag::Payload> first_message(const rosbag::Bag& bag, std::string_view topic);

}  // namespace turnscan::importers
