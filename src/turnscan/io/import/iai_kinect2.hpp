#pragma once
// Calibrations of a Kinect v2 in the layout of iai_kinect2: a folder of calib_*.yaml files.

#include <filesystem>
#include <optional>
#include <turnscan/core/calibration.hpp>

namespace turnscan {

/// What was found in the folder; at least one of them.
struct Kinect2Calibration {
  std::optional<DepthCorrection> depth;    ///< depthShift of calib_depth.yaml
  std::optional<CameraCorrection> camera;  ///< calib_ir.yaml; colour if its files are there, too
};

/// Reads calib_depth.yaml (depthShift, millimetres, which is added to every depth), calib_ir.yaml
/// (512 x 424), and, where both are there, calib_color.yaml (1920 x 1080) and calib_pose.yaml,
/// whose rotation and translation (metres) take a point from the depth to the colour camera.
/// The images are expected as that driver's users see them: not mirrored. Five to
/// eight coefficients of distortion are taken.
/// Fails with kNotFound with neither of the first two, and with kFormat when a value is missing,
/// wrong or beyond 1 m, or a rotation is none.
Result<Kinect2Calibration> read_iai_kinect2(const std::filesystem::path& folder);

}  // namespace turnscan
