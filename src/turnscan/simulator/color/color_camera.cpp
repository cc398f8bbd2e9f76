#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/color/color_camera.hpp>

namespace turnscan {

namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

/// Pans to its right after it has tilted up; then it is translated to `eye` in the sensor's frame.
Pose color_pose(const Vec3d& eye, double pan_rad, double tilt_rad) {
  Pose T_sensor_color = Pose::Identity();
  T_sensor_color.linear() =
      (Eigen::AngleAxisd(pan_rad, Vec3d::UnitY()) * Eigen::AngleAxisd(tilt_rad, Vec3d::UnitX()))
          .toRotationMatrix();
  T_sensor_color.translation() = eye;
  return T_sensor_color.inverse();
}

}  // namespace

OptionTable describe(ColorCameraOptions& o) {
  OptionTable table;
  table
      .number("colour-width", o.width, {0, 8192},
              "Columns of a separate colour camera beside each depth camera, for --scan-colour; 0: "
              "colours are registered to depth and lit from the sensor, and the options below do "
              "not apply.")
      .number("colour-height", o.height, {0, 8192}, "Its rows; 0: 9/16 of the columns.")
      .number("colour-fov", o.fov_y_rad, Quantity::kAngle, {0.01, 2.5},
              "Its vertical field of view.")
      .number("colour-x", o.x_m, Quantity::kLength, {-1.0, 1.0},
              "Its position to the right of the depth camera.")
      .number("colour-y", o.y_m, Quantity::kLength, {-1.0, 1.0},
              "Its position below the depth camera.")
      .number("colour-z", o.z_m, Quantity::kLength, {-1.0, 1.0},
              "Its position in front of the depth camera.")
      .number("colour-pan", o.pan_rad, Quantity::kAngle, {-0.5, 0.5}, "Its rotation to the right.")
      .number("colour-tilt", o.tilt_rad, Quantity::kAngle, {-0.5, 0.5}, "Its rotation upwards.")
      .number(
          "colour-delay", o.delay_s, Quantity::kTime, {-1.0, 1.0},
          "How much later its images are taken than those of depth; the recording does not say.")
      .number("colour-jitter", o.jitter_s, Quantity::kTime, {0.0, 1.0},
              "Random part of that delay in each frame, up to this either way, as of streams that "
              "are not synchronised.")
      .number("colour-noise", o.noise, Quantity::kNone, {0.0, 100.0},
              "Standard deviation of its noise, of 255 levels.")
      .number("colour-drift", o.drift, Quantity::kNone, {0.0, 0.9},
              "Exposure wanders from frame to frame, by up to this share to either side.")
      .number("colour-white-drift", o.white_drift, Quantity::kNone, {0.0, 0.9},
              "White balance wanders: red and blue against green, by up to this share.")
      .number("colour-vignetting", o.vignetting, Quantity::kNone, {0.0, 0.9},
              "Vignetting: share of the light that the corners of the image lack.")
      .number("colour-lamp", o.lamp, Quantity::kNone, {0.0, 1.0},
              "Share of the light that comes from a lamp far away, which stands still; the rest "
              "comes from all sides alike.")
      .number("colour-lamp-azimuth", o.lamp_azimuth_rad, Quantity::kAngle,
              {-4 * kRightAngle, 4 * kRightAngle}, "Where the lamp is, as a scanner's azimuth.")
      .number("colour-lamp-elevation", o.lamp_elevation_rad, Quantity::kAngle,
              {-kRightAngle, kRightAngle}, "Its height above the horizontal.")
      .number(
          "colour-gloss", o.gloss, Quantity::kNone, {0.0, 1.0},
          "Specular reflection of the lamp at the middle of the highlight, as a share of white.")
      .number("colour-given-turn", o.given_turn_rad, Quantity::kAngle, {-0.2, 0.2},
              "Error of its rotation in the recording.")
      .number("colour-given-shift", o.given_shift_m, Quantity::kLength, {-0.1, 0.1},
              "Error of its position in the recording.");
  return table;
}

CameraIntrinsics intrinsics_of(const ColorCameraOptions& o) {
  CameraIntrinsics camera;
  camera.width = o.width;
  camera.height = o.height > 0 ? o.height : std::max(1, o.width * 9 / 16);
  camera.fy = 0.5 * camera.height / std::tan(0.5 * o.fov_y_rad);
  camera.fx = camera.fy;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

Pose true_T_color_sensor(const ColorCameraOptions& o) {
  return color_pose({o.x_m, o.y_m, o.z_m}, o.pan_rad, o.tilt_rad);
}

double late_s(const ColorCameraOptions& o, std::uint64_t key) {
  return o.delay_s + o.jitter_s * (2.0 * uniform01(mix64(key + 3)) - 1.0);
}

Pose given_T_color_sensor(const ColorCameraOptions& o) {
  // A typical measurement error with a component along each axis.
  const Vec3d axis = Vec3d(0.6, 0.64, 0.48);
  const Vec3d shift = o.given_shift_m * Vec3d(0.64, -0.6, 0.48);
  Pose error = Pose::Identity();
  error.linear() = Eigen::AngleAxisd(o.given_turn_rad, axis.normalized()).toRotationMatrix();
  error.translation() = shift;
  return error * true_T_color_sensor(o);
}

}  // namespace turnscan
