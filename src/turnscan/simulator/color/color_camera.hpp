#pragma once
// The colour camera of a virtual depth camera, and its light.

#include <cstdint>
#include <optional>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

struct ColorCameraOptions {
  /// Pixels; 0: colours are registered to depth, lit from the sensor, and nothing below applies.
  int width = 0;
  int height = 0;                                  ///< 0: 9/16 of the width
  double fov_y_rad = 0.9424777960769379;           ///< 54 deg, from edge to edge
  double x_m = 0.05, y_m = 0.0, z_m = 0.0;         ///< of its eye, in the sensor's frame
  double pan_rad = 0.0, tilt_rad = 0.0;            ///< to its right, and up
  double delay_s = 0.0;                            ///< its images are later than those of depth,
  double jitter_s = 0.0;                           ///< by up to this more or less in each frame
  double noise = 0.0;                              ///< standard deviation, of 255 grey levels
  double drift = 0.0;                              ///< exposure wanders by that share, up and down
  double white_drift = 0.0;                        ///< red and blue wander against green
  double vignetting = 0.0;                         ///< share of the light that the corners lack
  double lamp = 0.0;                               ///< share of the light that comes from the lamp
  double lamp_azimuth_rad = 0.0;                   ///< of the lamp, as a scanner's
  double lamp_elevation_rad = 0.7853981633974483;  ///< 45 deg above the horizontal
  double gloss = 0.0;                              ///< what a mirror of the lamp adds, of white
  double given_turn_rad = 0.0;  ///< by which the recording has it wrong: turned about its axes,
  double given_shift_m = 0.0;   ///< and shifted
};

OptionTable describe(ColorCameraOptions& options);

/// Its image, without distortion. Precondition: width > 0.
CameraIntrinsics intrinsics_of(const ColorCameraOptions& options);
/// Takes points of the depth sensor to the colour camera: where it is.
Pose true_T_color_sensor(const ColorCameraOptions& options);
/// By how much the image of a frame is later than its depth image; key: of the frame, random.
double late_s(const ColorCameraOptions& options, std::uint64_t key);
/// Where the recording says that it is.
Pose given_T_color_sensor(const ColorCameraOptions& options);

}  // namespace turnscan
