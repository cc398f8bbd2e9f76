#pragma once
// Parsers for the messages of ROS 1 and 2 that contain images and related data. They follow the
// definitions in sensor_msgs, geometry_msgs, diagnostic_msgs and tf2_msgs
// (https://docs.ros.org/en/noetic/api/sensor_msgs/html/msg/Image.html and so on; ROS 2 has the same
// fields but for the number in the header), serialised as WireFields says.
// All fail with kFormat if the message is shorter than it claims.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/rosbag/bag_index.hpp>
#include <vector>

namespace turnscan::rosbag {

/// std_msgs/Header. Texts refer to the message.
struct Header {
  std::uint32_t seq = 0;
  std::int64_t stamp_ns = 0;
  std::string_view frame_id;
};

struct ImageMessage {
  Header header;
  std::uint32_t width = 0, height = 0, step = 0;  ///< step: bytes of a row
  std::string_view encoding;
  bool big_endian = false;
  std::string_view data;
  /// Metres per step, which librealsense appends to depth images if frame_id is "1".
  std::optional<float> depth_units;
};

struct CompressedImageMessage {
  Header header;
  std::string_view format;
  std::string_view data;
};

struct CameraInfoMessage {
  Header header;
  std::uint32_t width = 0, height = 0;
  std::string_view distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{};
  std::array<double, 12> p{};
};

struct KeyValue {
  std::string_view key, value;
};

struct TransformStamped {
  std::string parent, child;
  Pose T_parent_child = Pose::Identity();
};

/// The header of any message that begins with one; the message may be truncated after it.
Result<Header> parse_header(std::string_view bytes, Wire wire = Wire::kRos1);
Result<ImageMessage> parse_image(std::string_view bytes, Wire wire = Wire::kRos1);
Result<CompressedImageMessage> parse_compressed_image(std::string_view bytes,
                                                      Wire wire = Wire::kRos1);
Result<CameraInfoMessage> parse_camera_info(std::string_view bytes, Wire wire = Wire::kRos1);
Result<KeyValue> parse_key_value(std::string_view bytes, Wire wire = Wire::kRos1);
Result<float> parse_float32(std::string_view bytes, Wire wire = Wire::kRos1);
/// geometry_msgs/Transform. Also fails if it is not a rigid motion.
Result<Pose> parse_transform(std::string_view bytes, Wire wire = Wire::kRos1);
/// tf2_msgs/TFMessage. Transforms that are not rigid motions are skipped.
Result<std::vector<TransformStamped>> parse_transforms(std::string_view bytes,
                                                       Wire wire = Wire::kRos1);

}  // namespace turnscan::rosbag
