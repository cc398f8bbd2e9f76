#pragma once
// The pixels of ROS's image messages as ours. Encodings after sensor_msgs/image_encodings.h and
// REP 118 (https://www.ros.org/reps/rep-0118.html): depth is 16UC1 in millimetres or 32FC1 in
// metres, not a number where there is no return; after librealsense also mono16. Compressed depth
// after the package compressed_depth_image_transport.

#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/rosbag/ros_messages.hpp>

namespace turnscan::importers {

bool is_integer_depth(std::string_view encoding);  ///< 16UC1, mono16
bool is_float_depth(std::string_view encoding);    ///< 32FC1
bool is_color(std::string_view encoding);          ///< that ros_color() reads

/// Integers as they are, but that 65535 becomes kNoReturn; floating point in steps of unit_m, and
/// kNoReturn where it is none or beyond 65534 steps. Fails with kUnsupported for other encodings,
/// kFormat when the data do not fit the size.
Result<DepthImage> ros_depth(const rosbag::ImageMessage& image, double unit_m);

/// Encoding of the depth in a compressed image: "16UC1", "32FC1"; empty: it is no depth.
std::string_view compressed_depth_encoding(std::string_view format);
Result<DepthImage> ros_depth(const rosbag::CompressedImageMessage& image, double unit_m);

Result<ColorImage> ros_color(const rosbag::ImageMessage& image);
/// JPEG or PNG, into the frame's colour.
Result<> take_ros_color(const rosbag::CompressedImageMessage& image, Frame& frame);

}  // namespace turnscan::importers
