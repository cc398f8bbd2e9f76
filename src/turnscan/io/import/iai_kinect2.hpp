#pragma once
// Reads calibrations of a Kinect v2 in the layout of iai_kinect2: a folder of calib_*.yaml files.

#include <filesystem>
#include <optional>
#include <turnscan/core/calibration.hpp>

namespace turnscan {

/// What the folder contains; at least one of them.
struct Kinect2Calibration {
  std::optional<DepthCorrection> depth;  ///< depthShift of calib_depth.yaml
  /// calib_ir.yaml; also the colour camera if its files are present.
  std::optional<CameraCorrection> camera;
};

/// Reads calib_depth.yaml (depthShift, millimetres, which is added to every depth), calib_ir.yaml
/// (512 x 424), and, if both exist, calib_color.yaml (1920 x 1080) and calib_pose.yaml, whose
/// rotation and translation (metres) transform a point from the depth to the colour camera.
/// The images are assumed to be as users of that driver see them: not mirrored. Five to eight
/// distortion coefficients are accepted.
/// Fails with kNotFound if neither of the first two exists, and with kFormat if a value is missing,
/// wrong or beyond 1 m, or a rotation is invalid.
Result<Kinect2Calibration> read_iai_kinect2(const std::filesystem::path& folder);

}  // namespace turnscan
