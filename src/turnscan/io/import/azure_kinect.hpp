#pragma once
// The calibration.json of an Azure Kinect, which the Femto Bolt and Mega write as well. Its form
// and what becomes of it in each mode: Azure-Kinect-Sensor-SDK (MIT licence), src/calibration and
// src/transformation/mode_specific_calibration.c. Focal length and centre are in widths and heights
// of the whole sensor, counted from the corner of its first pixel; a mode crops and bins it.

#include <optional>
#include <string_view>
#include <turnscan/core/camera.hpp>

namespace turnscan::importers {

struct AzureKinectCameras {
  CameraIntrinsics depth;
  /// Distance from the axis at z = 1 up to which the depth camera's lens is known: about 60 deg.
  double depth_radius = 0.0;
  std::optional<CameraIntrinsics> color;
  Pose T_color_depth = Pose::Identity();
};

struct ImageSize {
  int width = 0, height = 0;
};

/// Name of the depth mode with images of that size; empty: there is none.
std::string_view azure_kinect_depth_mode(const ImageSize& size);

/// The cameras for images of these sizes; without `color` that one is left out, and also where no
/// mode has images of its size. json may end with zero bytes.
/// Fails with kFormat when a value is missing or makes no sense, and with kUnsupported for sizes of
/// depth that no mode has and for other lens models than
/// CALIBRATION_LensDistortionModelBrownConrady.
Result<AzureKinectCameras> parse_azure_kinect(std::string_view json, const ImageSize& depth,
                                              const std::optional<ImageSize>& color);

}  // namespace turnscan::importers
