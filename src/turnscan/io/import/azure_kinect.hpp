#pragma once
// Parses the calibration.json of an Azure Kinect, which the Femto Bolt and Mega write as well. Its
// layout and its conversion for each mode follow Azure-Kinect-Sensor-SDK (MIT licence),
// src/calibration and src/transformation/mode_specific_calibration.c. Focal length and centre are
// relative to the width and height of the whole sensor, measured from the corner of its first
// pixel; a mode crops and bins the sensor.

#include <optional>
#include <string_view>
#include <turnscan/core/camera.hpp>

namespace turnscan::importers {

struct AzureKinectCameras {
  CameraIntrinsics depth;
  /// Distance from the axis at z = 1 up to which the depth camera's lens model is valid: about 60
  /// deg.
  double depth_radius = 0.0;
  std::optional<CameraIntrinsics> color;
  Pose T_color_depth = Pose::Identity();
};

struct ImageSize {
  int width = 0, height = 0;
};

/// Name of the depth mode with images of that size; empty if there is none.
std::string_view azure_kinect_depth_mode(const ImageSize& size);

/// The cameras for images of these sizes; the colour camera is omitted without `color`, and if no
/// mode has images of its size. json may end with zero bytes.
/// Fails with kFormat if a value is missing or implausible, and with kUnsupported for depth sizes
/// that no mode has and for lens models other than CALIBRATION_LensDistortionModelBrownConrady.
Result<AzureKinectCameras> parse_azure_kinect(std::string_view json, const ImageSize& depth,
                                              const std::optional<ImageSize>& color);

}  // namespace turnscan::importers
