#include <turnscan/workflow/verdict/pose_error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

namespace turnscan {

namespace {

/// Share of a deviation perpendicular to the axis, of unknown direction, along a given direction.
constexpr double kOneDirection = std::numbers::sqrt2 / 2.0;

}  // namespace

double PoseError::along_normal_m(const Vec3d& arm_m, const Vec3d& normal) const {
  const double across = std::hypot(normal.x(), normal.z());
  const double lever = std::abs(arm_m.cross(normal).dot(Vec3d::UnitY().cross(normal)));
  return std::hypot(shift_m * across, tilt_rad * lever);
}

PoseError pose_error(const ScanKnowledge& known) {
  PoseError out;
  const CalibrationChoice* choice = known.choice;
  if (choice == nullptr) return out;
  if (choice->calibration) {
    const Calibration& found = *choice->calibration;
    if (std::isfinite(found.center_sigma_m)) out.shift_m = found.center_sigma_m;
    if (std::isfinite(found.axis_sigma_rad)) out.tilt_rad = found.axis_sigma_rad;
  } else if (const auto& offset = choice->checks.axis_offset) {
    out.shift_m = std::max(offset->shift_sigma_m, 0.5 * offset->shift_m);
    out.tilt_rad = std::max(offset->tilt_sigma_rad, 0.5 * offset->tilt_rad);
  } else if (known.platter && known.platter->moved) {
    out.shift_m = 0.5 * known.platter->shift_m;
    out.tilt_rad = 0.5 * known.platter->tilt_rad;
  }
  out.shift_m *= kOneDirection;
  out.tilt_rad *= kOneDirection;
  if (const auto& closure = choice->checks.closure)
    out.shift_m = std::max(out.shift_m,
                           0.5 * std::sqrt(std::max(0.0, closure->shift_m * closure->shift_m -
                                                             closure->noise_m * closure->noise_m)));
  return out;
}

}  // namespace turnscan
