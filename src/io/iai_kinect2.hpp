#pragma once
// Calibrations of a Kinect v2 in the layout of iai_kinect2: a folder of calib_*.yaml files.

#include <filesystem>
#include <optional>
#include <turnscan/core/camera.hpp>

namespace turnscan {

struct Kinect2Calibration {
  double depth_shift_m = 0.0;                  ///< to be added to every depth
  std::optional<CameraIntrinsics> intrinsics;  ///< of the depth camera, 512 x 424, if there
};

/// Reads calib_depth.yaml (depthShift, millimetres) and, if it is there, calib_ir.yaml. Fails with
/// kNotFound without the first, with kFormat when a value is missing, wrong or beyond 1 m.
Result<Kinect2Calibration> read_iai_kinect2(const std::filesystem::path& folder);

}  // namespace turnscan
