#pragma once
// Converts ROS's camera_info to a camera, with the lens model names of ROS and librealsense.

#include <turnscan/core/camera.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/rosbag/ros_messages.hpp>

namespace turnscan::importers {

/// rectified: for images rectified by image_proc, whose camera is P without distortion
/// (https://wiki.ros.org/image_pipeline/CameraInfo). Known models: none, plumb_bob,
/// rational_polynomial, "Brown Conrady"; "Inverse Brown Conrady" (librealsense's rsutil.h: the
/// polynomial maps distorted points to undistorted ones) is converted to the nearest Brown-Conrady
/// lens. Fails with kUnsupported if that deviates by more than 0.3 pixels and for other models, and
/// with kFormat if the message is not a valid camera.
Result<CameraIntrinsics> ros_camera(const rosbag::CameraInfoMessage& info, bool rectified);

}  // namespace turnscan::importers
