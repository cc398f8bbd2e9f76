#pragma once
// What a Kinect for Xbox 360 measures: raw shifts of its pattern, as depths. No hardware in it.

#include <cmath>
#include <cstdint>
#include <vector>

namespace turnscan::plugin {

/// Constants of one device. The defaults are those of the sensor's design, with which
/// libfreenect's own tables are made when a device does not tell its own.
struct KinectV1 {
  double baseline_cm = 7.5;     ///< between infrared camera and projector
  double reference_cm = 120.0;  ///< distance of the reference plane
  double pixel = 0.1042;        ///< size of a pixel of half the resolution on the sensor
  double shift = 200.0;         ///< of the pattern at the reference plane
  /// Of the colour camera's image of 640 pixels, from which registered depth is seen (the nominal
  /// value of ROS's openni_camera: 1050 for 1280 pixels). No device tells its own.
  double color_focal_pixels = 525.0;

  /// Of the image of 640 pixels: reference distance over the size of two of its pixels.
  double focal_pixels() const { return reference_cm / (2.0 * pixel); }

  /// Depth of a raw value of 11 bits; 0 where there is none. With d the shift against the
  /// reference plane in pixels, z = z0 + d p z0 / (b - d p) (Khoshelham and Elberink 2012, eq. 3 to
  /// 5, with the constants of libfreenect's registration.c).
  double depth_m(std::uint16_t raw) const {
    if (raw >= kNoValue) return 0.0;
    const double d = (raw - 4.0 * shift) / 4.0 - 0.375;
    const double metric = d * pixel;
    if (!(metric < baseline_cm)) return 0.0;
    const double z = 0.01 * (metric * reference_cm / (baseline_cm - metric) + reference_cm);
    return z > 0.0 && z < 10.0 ? z : 0.0;
  }

  /// Table of all raw values, in steps of 0.1 mm; 0: no return, also where a step does not fit.
  std::vector<std::uint16_t> table() const {
    std::vector<std::uint16_t> steps(2048, 0);
    for (std::uint16_t raw = 0; raw < 2048; ++raw) {
      const double step = std::round(depth_m(raw) * 1e4);
      if (step > 0.0 && step < 65535.0) steps[raw] = static_cast<std::uint16_t>(step);
    }
    return steps;
  }

  static constexpr std::uint16_t kNoValue = 2047;
};

}  // namespace turnscan::plugin
