#pragma once
// The colour camera of a virtual depth camera, and its illumination.

#include <cstdint>
#include <optional>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

struct ColorCameraOptions {
  /// Pixels; 0: colours are registered to depth, lit from the sensor, and the other options are
  /// ignored.
  int width = 0;
  int height = 0;                           ///< 0: 9/16 of the width
  double fov_y_rad = 0.9424777960769379;    ///< 54 deg, from edge to edge
  double x_m = 0.05, y_m = 0.0, z_m = 0.0;  ///< of its optical centre, in the sensor's frame
  double pan_rad = 0.0, tilt_rad = 0.0;     ///< to its right, and upwards
  double delay_s = 0.0;                     ///< its images are later than the depth images,
  double jitter_s = 0.0;                    ///< by up to this more or less in each frame
  double noise = 0.0;                       ///< standard deviation, of 255 grey levels
  double drift = 0.0;                       ///< the exposure varies by this share, up and down
  double white_drift = 0.0;                 ///< red and blue vary relative to green
  double vignetting = 0.0;                  ///< share of the light missing in the corners
  double lamp = 0.0;                        ///< share of the light that comes from the lamp
  double lamp_azimuth_rad = 0.0;            ///< of the lamp, as for a scanner
  double lamp_elevation_rad = 0.7853981633974483;  ///< 45 deg above the horizontal
  double gloss = 0.0;           ///< what a mirror of the lamp adds, relative to white
  double given_turn_rad = 0.0;  ///< error of the recorded pose: rotated about its axes,
  double given_shift_m = 0.0;   ///< and translated
};

OptionTable describe(ColorCameraOptions& options);

/// Its intrinsics, without distortion. Precondition: width > 0.
CameraIntrinsics intrinsics_of(const ColorCameraOptions& options);
/// Maps points from the depth sensor to the colour camera: its true pose.
Pose true_T_color_sensor(const ColorCameraOptions& options);
/// Delay of the colour image of a frame relative to its depth image; key: random, of the frame.
double late_s(const ColorCameraOptions& options, std::uint64_t key);
/// The pose that is recorded.
Pose given_T_color_sensor(const ColorCameraOptions& options);

}  // namespace turnscan
