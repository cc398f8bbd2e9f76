#pragma once
// Accuracy of a turntable calibration as text.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/calibration.hpp>

namespace turnscan::workflow {

/// "axis to 0.03 deg, centre to 0.05 mm", or "how exactly is not known".
inline std::string exactness_text(const Calibration& calibration) {
  const double axis_deg = calibration.axis_sigma_rad * kDegreesPerRadian;
  const double center_mm = calibration.center_sigma_m * 1e3;
  if (!std::isfinite(axis_deg) || !std::isfinite(center_mm)) return "how exactly is not known";
  return fmt::format("axis to {:.2f} deg, centre to {:.2f} mm", axis_deg, center_mm);
}

}  // namespace turnscan::workflow
