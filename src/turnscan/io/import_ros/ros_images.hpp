#pragma once
// Converts ROS's image messages. Encodings follow sensor_msgs/image_encodings.h and REP 118
// (https://www.ros.org/reps/rep-0118.html): depth is 16UC1 in millimetres or 32FC1 in metres, NaN
// if there is no return; following librealsense also mono16. Compressed depth follows the package
// compressed_depth_image_transport.

#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/rosbag/ros_messages.hpp>

namespace turnscan::importers {

bool is_integer_depth(std::string_view encoding);  ///< 16UC1, mono16
bool is_float_depth(std::string_view encoding);    ///< 32FC1
bool is_color(std::string_view encoding);          ///< supported by ros_color()

/// Integers are unchanged, except that 65535 becomes kNoReturn; floating-point values are converted
/// to steps of unit_m, and to kNoReturn if invalid or beyond 65534 steps. Fails with kUnsupported
/// for other encodings, kFormat if the data do not match the size.
Result<DepthImage> ros_depth(const rosbag::ImageMessage& image, double unit_m);

/// Encoding of the depth in a compressed image: "16UC1", "32FC1"; empty: not depth.
std::string_view compressed_depth_encoding(std::string_view format);
Result<DepthImage> ros_depth(const rosbag::CompressedImageMessage& image, double unit_m);

Result<ColorImage> ros_color(const rosbag::ImageMessage& image);
/// Decodes JPEG or PNG into the frame's colour.
Result<> take_ros_color(const rosbag::CompressedImageMessage& image, Frame& frame);

}  // namespace turnscan::importers
