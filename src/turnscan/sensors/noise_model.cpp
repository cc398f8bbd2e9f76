#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/angles.hpp>
#include <turnscan/sensors/laser_line.hpp>
#include <turnscan/sensors/noise_model.hpp>

namespace turnscan {

namespace {

constexpr double kRightAngle = kTurn / 4;
/// Keeps the formulae finite at a right angle: 0.06 deg short of it.
constexpr double kMaxIncidence = kRightAngle - 1e-3;

constexpr Range kLength{0.0, 1.0};
constexpr Range kFactor{-1e3, 1e3};
constexpr Range kPixels{0.0, 100.0};
constexpr Range kAngle{0.0, kRightAngle};
constexpr Range kCount{0.0, 1e9};

double clamped(double incidence_rad) { return std::clamp(incidence_rad, 0.0, kMaxIncidence); }

void describe_axial(OptionTable& table, NoiseModel& m) {
  table
      .number("axial-constant", m.axial_constant_m, Quantity::kLength, {-1.0, 1.0},
              "Axial sigma: constant part.")
      .number("axial-linear", m.axial_linear, Quantity::kNone, kFactor,
              "Axial sigma: metres for each metre of depth beyond axial-linear-from.")
      .number("axial-linear-from", m.axial_linear_from_m, Quantity::kLength, {0.0, 100.0},
              "Depth from which axial-linear counts.")
      .number("axial-quadratic", m.axial_quadratic_per_m, Quantity::kNone, kFactor,
              "Axial sigma: metres for each square metre of (depth - axial-quadratic-at).")
      .number("axial-quadratic-at", m.axial_quadratic_at_m, Quantity::kLength, {0.0, 100.0},
              "Depth at which the quadratic part is zero.")
      .number("axial-grazing", m.axial_grazing, Quantity::kNone, kLength,
              "Axial sigma: factor of t^2 / (pi/2 - t)^2 at 1 m, t the incidence; metres.")
      .number("axial-grazing-power", m.axial_grazing_power, Quantity::kNone, {-4.0, 4.0},
              "Power of the depth that axial-grazing grows with.")
      .number("axial-grazing-from", m.axial_grazing_from_rad, Quantity::kAngle, kAngle,
              "Incidence from which axial-grazing counts.")
      .number("lateral-px", m.lateral_px, Quantity::kNone, kPixels,
              "Lateral sigma: constant part, pixels.")
      .number("lateral-grazing-px", m.lateral_grazing_px, Quantity::kNone, kPixels,
              "Lateral sigma: factor of t / (pi/2 - t), pixels.")
      .number("lateral-length", m.lateral_m, Quantity::kLength, kLength,
              "Lateral sigma: a length, at every depth.")
      .number("lateral-per-metre", m.lateral_per_m, Quantity::kNone, {0.0, 1.0},
              "Lateral sigma: metres for each metre of depth.");
}

void describe_defects(OptionTable& table, NoiseModel& m) {
  table
      .number("disparity-sigma", m.disparity_sigma_px, Quantity::kNone, kPixels,
              "Noise of the disparity, pixels.")
      .number("disparity-step", m.disparity_step_px, Quantity::kNone, kPixels,
              "Step to which the sensor quantises the disparity, pixels; 0: none.")
      .number("bias", m.bias_m, Quantity::kLength, {-1.0, 1.0}, "Added to each depth.")
      .number("drop-from", m.drop_from_rad, Quantity::kAngle, kAngle,
              "Incidence from which returns get lost.")
      .number("drop-to", m.drop_to_rad, Quantity::kAngle, kAngle,
              "Incidence from which there is no return.")
      .number("dark-signal", m.dark_signal_per_m2, Quantity::kNone, {0.0, 1e6},
              "There is no return where albedo * cos(incidence) / depth^2 (metres) is less.")
      .number("dark-jitter", m.dark_jitter, Quantity::kNone, {0.0, 1.0},
              "Relative noise of that signal, one sigma.")
      .number("footprint-px", m.footprint_px, Quantity::kNone, {0.0, 8.0},
              "Side of the square that a pixel sees, pixels; 0: a point.")
      .number("mixed-rejection", m.mixed_rejection_m, Quantity::kLength, {0.0, 100.0},
              "A mixed pixel farther than this from both the nearest and the farthest thing that "
              "it sees has no return; 0: all are kept.")
      .number("window-px", m.window_px, {0, 63},
              "Side of the window in which the projector's dots are found, pixels; 0: none.")
      .number("window-dots", m.window_dots, Quantity::kNone, {0.0, 1.0},
              "Dots of the projector for each pixel.")
      .number("window-share", m.window_share, Quantity::kNone, {0.0, 1.0},
              "No return where fewer of the window's dots are seen at the pixel's disparity.")
      .number("window-agreement", m.window_agreement_px, Quantity::kNone, kPixels,
              "How far their disparity may differ, pixels.");
}

void describe_physics(OptionTable& table, NoiseModel& m) {
  table
      .choice("physics", m.physics, {"none", "kinect-v2", "laser-line"},
              "What noise = physics simulates.")
      .number("tof-amplitude", m.tof_amplitude, Quantity::kNone, {0.0, 32767.0},
              "Amplitude of the correlation at 16 MHz: white, 1 m away, facing the sensor.")
      .number("tof-read-noise", m.tof_read_noise, Quantity::kNone, {0.0, 32767.0},
              "Noise of a correlation without signal, one sigma.")
      .number("tof-shot-noise", m.tof_shot_noise, Quantity::kNone, {0.0, 1000.0},
              "Variance of a correlation for each unit of amplitude.")
      .number("tof-relative-noise", m.tof_relative_noise, Quantity::kNone, {0.0, 1.0},
              "Noise of a correlation relative to its amplitude, one sigma.")
      .number("line-width", m.line_width_m, Quantity::kLength, kLength,
              "Width of the laser line on the surface, at half its height.")
      .number("line-wavelength", m.line_wavelength_m, Quantity::kLength, {0.0, 1e-4},
              "Wavelength of the laser.")
      .number("line-aperture", m.line_aperture, Quantity::kNone, {0.0, 1.0},
              "Sine of half the angle under which the surface sees the camera's aperture.")
      .number("line-contrast", m.line_contrast, Quantity::kNone, {0.0, 1.0},
              "Contrast of the speckle.")
      .number("line-focal", m.line_focal_px, Quantity::kNone, {0.0, 1e6},
              "Focal length of the camera across the line, pixels.")
      .number("line-blur", m.line_blur_px, Quantity::kNone, {0.1, 10.0},
              "One sigma of the image of a point, pixels.")
      .number("line-exposure", m.line_exposure, Quantity::kNone, kCount,
              "Electrons at the peak of the line: white, 1 m away, facing the laser.")
      .number("line-read-noise", m.line_read_noise, Quantity::kNone, kCount,
              "Noise of a pixel without light, electrons, one sigma.")
      .number("line-full-well", m.line_full_well, Quantity::kNone, kCount,
              "Electrons that a pixel holds; 0: no limit.")
      .number("line-threshold", m.line_threshold, Quantity::kNone, kCount,
              "A peak of fewer electrons is none.");
}

}  // namespace

OptionTable describe(NoiseModel& model) {
  OptionTable table;
  describe_axial(table, model);
  describe_defects(table, model);
  describe_physics(table, model);
  return table;
}

double grazing_term(double incidence_rad) {
  const double t = clamped(incidence_rad), rest = kRightAngle - t;
  return t * t / (rest * rest);
}

double axial_sigma_m(const NoiseModel& m, double z_m, double incidence_rad) {
  const double off = z_m - m.axial_quadratic_at_m;
  double sigma = m.axial_constant_m + m.axial_linear * std::max(z_m - m.axial_linear_from_m, 0.0) +
                 m.axial_quadratic_per_m * off * off;
  if (m.axial_grazing > 0.0 && incidence_rad >= m.axial_grazing_from_rad)
    sigma += m.axial_grazing * std::pow(z_m, m.axial_grazing_power) * grazing_term(incidence_rad);
  return std::max(sigma, 0.0);
}

double lateral_sigma_px(const NoiseModel& m, double focal_px, double z_m, double incidence_rad) {
  const double t = clamped(incidence_rad);
  return m.lateral_px + m.lateral_grazing_px * t / (kRightAngle - t) +
         focal_px * (m.lateral_m / z_m + m.lateral_per_m);
}

double disparity_step_m(const NoiseModel& m, double focal_baseline, double z_m) {
  if (!(m.disparity_step_px > 0.0) || !(focal_baseline > 0.0)) return 0.0;
  return z_m * z_m / focal_baseline * m.disparity_step_px;
}

double quantised_depth_m(const NoiseModel& m, double focal_baseline, double z_m) {
  if (!(m.disparity_step_px > 0.0) || !(focal_baseline > 0.0)) return z_m;
  const double steps = std::round(focal_baseline / (z_m * m.disparity_step_px));
  if (!(steps >= 1.0)) return std::numeric_limits<double>::infinity();
  return focal_baseline / (steps * m.disparity_step_px);
}

double predicted_sigma_m(const NoiseModel& m, double focal_baseline, double z_m,
                         double incidence_rad, double albedo) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double facing = std::cos(incidence_rad);
  if (incidence_rad >= m.drop_to_rad && m.drop_to_rad < kRightAngle) return kNone;
  if (albedo * facing / (z_m * z_m) < m.dark_signal_per_m2) return kNone;
  if (m.physics == SensorPhysics::kLaserLine && m.line_width_m > 0.0)
    return laser_line_sigma_m(m, focal_baseline, z_m, incidence_rad, albedo);
  const double axial = axial_sigma_m(m, z_m, incidence_rad);
  const double stereo =
      focal_baseline > 0.0 ? z_m * z_m / focal_baseline * m.disparity_sigma_px : 0.0;
  return std::max(std::hypot(axial, stereo),
                  disparity_step_m(m, focal_baseline, z_m) / std::sqrt(12.0));
}

}  // namespace turnscan
