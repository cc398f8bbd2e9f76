#pragma once
// A camera as ROS's camera_info describes it, by ROS's and by librealsense's names of lens models.

#include <turnscan/core/camera.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/rosbag/ros_messages.hpp>

namespace turnscan::importers {

/// rectified: of images that image_proc has rectified, whose camera is P without distortion
/// (https://wiki.ros.org/image_pipeline/CameraInfo). Known models: none, plumb_bob,
/// rational_polynomial, "Brown Conrady"; "Inverse Brown Conrady" (librealsense's rsutil.h: the
/// polynomial takes distorted points to undistorted ones) becomes the nearest Brown-Conrady lens.
/// Fails with kUnsupported where that is more than 0.3 pixels off and for other models, and with
/// kFormat when it is no camera.
Result<CameraIntrinsics> ros_camera(const rosbag::CameraInfoMessage& info, bool rectified);

}  // namespace turnscan::importers
