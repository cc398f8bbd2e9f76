#pragma once
// How a depth sensor errs: the numbers (the noise section of a scanner's file) and the formulae, as
// pure functions. docs/reference/noise.md names the source of each. z is the depth along the
// optical axis in metres, incidence the angle between the surface's normal and the ray in [0,
// pi/2).

#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// What `--noise physics` simulates instead of formulae.
enum class SensorPhysics {
  kNone,      ///< nothing beyond the formulae
  kKinectV2,  ///< nine correlations a pixel, decoded as the open driver does
  kLaserLine  ///< a spot profile a column, and a peak finder
};

/// All zero: a sensor without error.
struct NoiseModel {
  // Axial: sigma_z = constant + linear * max(z - linear_from, 0) + quadratic * (z - quadratic_at)^2
  //                + grazing * z^grazing_power * t^2 / (pi/2 - t)^2   with t = incidence,
  // the last term from grazing_from on.
  double axial_constant_m = 0.0;
  double axial_linear = 0.0;  ///< metres a metre
  double axial_linear_from_m = 0.0;
  double axial_quadratic_per_m = 0.0;
  double axial_quadratic_at_m = 0.0;
  double axial_grazing = 0.0;  ///< metres, at z = 1 m
  double axial_grazing_power = 0.0;
  double axial_grazing_from_rad = 0.0;

  // Lateral: sigma in pixels = px + grazing_px * t / (pi/2 - t) + f * (m / z + per_m).
  double lateral_px = 0.0;
  double lateral_grazing_px = 0.0;
  double lateral_m = 0.0;      ///< at every distance
  double lateral_per_m = 0.0;  ///< metres a metre of distance

  // Triangulation: disparity d = f * b / z, with noise and in steps.
  double disparity_sigma_px = 0.0;
  double disparity_step_px = 0.0;  ///< 0: no steps

  double bias_m = 0.0;  ///< added to each depth

  // Dropouts. Beyond drop_from the chance of no return rises linearly, to 1 at drop_to. A surface
  // is too dark where albedo * cos(incidence) / z^2 * (1 + dark_jitter * normal) < dark_signal.
  double drop_from_rad = 1.5707963267948966;
  double drop_to_rad = 1.5707963267948966;
  double dark_signal_per_m2 = 0.0;
  double dark_jitter = 0.0;

  // Mixed pixels: a pixel sees a square of this many pixels (0: a point). Its depth is dropped when
  // it is farther than mixed_rejection from both the nearest and the farthest thing it sees (0:
  // never).
  double footprint_px = 0.0;
  double mixed_rejection_m = 0.0;

  // Structured light: the pixel is found by the projector's dots in a window about it. It is lost
  // where fewer than window_share of those that its disparity lets expect are there, within
  // window_agreement of that disparity.
  int window_px = 0;                 ///< side of the window; 0: no window
  double window_dots = 0.1;          ///< dots for each pixel
  double window_share = 0.8;         ///< 0 to 1
  double window_agreement_px = 1.0;  ///< of the disparity

  SensorPhysics physics = SensorPhysics::kNone;

  // Kinect v2, in the units of the driver's correlations (11 bit, expanded to 16).
  double tof_amplitude = 500.0;  ///< of 16 MHz, from a white surface at 1 m that faces the sensor
  double tof_read_noise = 1.2;   ///< one sigma; read-out and ambient light
  double tof_shot_noise = 0.02;  ///< variance for each unit of amplitude
  double tof_relative_noise = 0.023;  ///< one sigma, of the amplitude

  // Laser line.
  double line_width_m = 0.0;  ///< full width at half maximum, at every distance
  double line_wavelength_m = 0.0;
  double line_aperture =
      0.0;  ///< sine of half the angle of the camera's aperture, from the surface
  double line_contrast = 0.0;    ///< of the speckle, 0 to 1
  double line_focal_px = 0.0;    ///< focal length of the camera across the line
  double line_blur_px = 0.8;     ///< one sigma of the image of a point
  double line_exposure = 0.0;    ///< electrons at the peak: white, 1 m away, facing the laser
  double line_read_noise = 0.0;  ///< electrons
  double line_full_well = 0.0;   ///< electrons; brighter is cut off
  double line_threshold = 0.0;   ///< electrons; a lower peak is none
};

/// Names are those of the noise section of a scanner's file.
OptionTable describe(NoiseModel& model);

/// t^2 / (pi/2 - t)^2, finite up to pi/2.
double grazing_term(double incidence_rad);

/// One sigma along z of the formula, without disparity noise and steps; never negative.
double axial_sigma_m(const NoiseModel& model, double z_m, double incidence_rad);

/// One sigma across the image, in pixels.
double lateral_sigma_px(const NoiseModel& model, double focal_px, double z_m, double incidence_rad);

/// Depth of one step of the disparity at z; 0 without steps. focal_baseline is f * b in
/// pixel * metres.
double disparity_step_m(const NoiseModel& model, double focal_baseline, double z_m);

/// The depth of the nearest disparity that the sensor can tell; z itself without steps.
/// Infinite for a disparity rounded to zero.
double quantised_depth_m(const NoiseModel& model, double focal_baseline, double z_m);

/// One sigma of a single sample: axial formula and disparity noise together, no less than what the
/// steps alone give (step / sqrt(12)). For a laser line (physics = laser-line with a width):
/// speckle and the noise of the peak. NaN where the surface is too dark, or beyond drop_to.
double predicted_sigma_m(const NoiseModel& model, double focal_baseline, double z_m,
                         double incidence_rad, double albedo);

}  // namespace turnscan
