#include <cmath>
#include <numbers>
#include <turnscan/simulator/color/color_response.hpp>

namespace turnscan::sampling {

const SrgbCurve& SrgbCurve::instance() {
  static const SrgbCurve curve;
  return curve;
}

SrgbCurve::SrgbCurve() {
  for (std::size_t i = 0; i < linear_.size(); ++i) {
    const double s = double(i) / kLevels;
    linear_[i] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  for (std::size_t i = 0; i < srgb_.size(); ++i) {
    const double l = double(i) / kLights;
    srgb_[i] = float(255.0 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055));
  }
}

float SrgbCurve::beyond(float linear) {
  return 255.0f * (1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f);
}

const NoiseTable& NoiseTable::instance() {
  static const NoiseTable table;
  return table;
}

NoiseTable::NoiseTable() {
  // The quantiles at the middle of each share, by Newton's method starting at the previous one.
  double x = 0.0;
  for (std::size_t i = 0; i < kValues / 2; ++i) {
    const double upper = 0.5 - (double(i) + 0.5) / double(kValues);  // probability beyond x
    for (int step = 0; step < 6; ++step) {
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      x += (0.5 * std::erfc(x / std::numbers::sqrt2) - upper) / density;
    }
    values_[kValues / 2 + i] = float(x);
    values_[kValues / 2 - 1 - i] = float(-x);
  }
}

}  // namespace turnscan::sampling
