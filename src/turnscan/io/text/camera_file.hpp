#pragma once
// Camera intrinsics as calibration programs write them.

#include <string_view>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::text {

/// From nine numbers (a 3x3 matrix row by row), from YAML of OpenCV or ROS (camera_matrix or K,
/// distortion_coefficients or D, image_width or width), or from JSON with the same names, with fx,
/// fy, cx and cy, or with Open3D's intrinsic_matrix (column by column). The size is 0 x 0 if it is
/// not stated. Fails with kFormat, and with kUnsupported for the lens of a fisheye.
Result<CameraIntrinsics> parse_camera_file(std::string_view text);

}  // namespace turnscan::text
