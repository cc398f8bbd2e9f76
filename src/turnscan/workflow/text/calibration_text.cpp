#include <turnscan/workflow/text/calibration_text.hpp>

#include <turnscan/core/units.hpp>

#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

/// "12.345 mm", or "12.345 +- 0.012 mm".
std::string figure(double value, double sigma, double scale, const char* unit, int digits) {
  if (!std::isfinite(sigma)) return fmt::format("{:.{}f} {}", value * scale, digits, unit);
  return fmt::format("{:.{}f} +- {:.{}f} {}", value * scale, digits, sigma * scale, digits, unit);
}

std::string vector_text(const Vec3d& v, double scale, int digits) {
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", v.x() * scale, digits, v.y() * scale, digits,
                     v.z() * scale, digits);
}

std::string spread(double sigma, double scale, const char* unit) {
  return std::isfinite(sigma) ? fmt::format(" +- {:.3f} {}", sigma * scale, unit) : "";
}

std::string corrections_text(const std::string& whose, const std::optional<DepthCorrection>& depth,
                             const std::optional<CameraCorrection>& camera) {
  std::string text;
  if (depth)
    text += fmt::format("{}Depth: {:+.2f} mm, times {:.5f} ({})\n", whose, depth->bias_m * 1e3,
                        depth->scale, depth->found);
  if (camera)
    text += fmt::format("{}Camera: fx {:.2f}, fy {:.2f}, cx {:.2f}, cy {:.2f} ({})\n", whose,
                        camera->intrinsics.fx, camera->intrinsics.fy, camera->intrinsics.cx,
                        camera->intrinsics.cy, camera->found);
  return text;
}

}  // namespace

std::string calibration_text(const Calibration& c) {
  workflow::TextTable table({0, 1, 2});
  table.add({"axis",
             vector_text(c.table.axis, 1.0, 5) + spread(c.axis_sigma_rad, kDegreesPerRadian, "deg"),
             c.axis_found});
  table.add({"centre",
             vector_text(c.table.center_m, 1e3, 2) + " mm" +
                 spread(c.center_sigma_m, 1e3, "mm across") +
                 (std::isfinite(c.height_sigma_m) ? "," : "") +
                 spread(c.height_sigma_m, 1e3, "mm along the axis"),
             c.center_found});
  if (c.table.radius_m)
    table.add(
        {"radius", figure(*c.table.radius_m, c.radius_sigma_m, 1e3, "mm", 2), c.radius_found});
  if (c.table.reach_m && !c.table.radius_m)
    table.add({"reach", fmt::format("{:.0f} mm", *c.table.reach_m * 1e3),
               "largest radius at which something turns"});
  if (c.table.speed_rad_s)
    table.add({"speed",
               figure(*c.table.speed_rad_s, c.speed_sigma_rad_s, kDegreesPerRadian, "deg/s", 4),
               c.speed_found});
  if (!c.angles_rad.empty())
    table.add({"angles",
               fmt::format("{}, the last {:.3f} deg", c.angles_rad.size(),
                           c.angles_rad.back() * kDegreesPerRadian),
               c.angles_found});
  if (c.start_s)
    table.add({"start", fmt::format("{:.3f} s", *c.start_s), "time at which it began to turn"});
  std::string text = fmt::format("Found by: {}\n", name_of(c.method)) + table.text(2);
  if (std::isfinite(c.residual_rms_m))
    text += fmt::format("Residuals: {:.3f} mm RMS", c.residual_rms_m * 1e3);
  if (std::isfinite(c.residual_mean_abs_m))
    text += fmt::format(", {:.3f} mm mean", c.residual_mean_abs_m * 1e3);
  if (std::isfinite(c.rim_share)) text += fmt::format(", {:.0f} % of the rim", c.rim_share * 100);
  if (std::isfinite(c.confidence)) text += fmt::format(", confidence {:.2f}", c.confidence);
  text += "\n";
  if (!c.undetermined.empty())
    text += fmt::format("Not determined by the data: {}\n", fmt::join(c.undetermined, ", "));
  text += corrections_text("", c.depth, c.camera);
  for (std::size_t i = 0; i < c.others.size(); ++i) {
    const SensorPlace& place = c.others[i];
    text += fmt::format("Sensor {}: at {} mm in the table's frame{}{} ({})\n", i + 1,
                        vector_text(place.T_table_sensor.translation(), 1e3, 1),
                        spread(place.shift_sigma_m, 1e3, "mm"),
                        spread(place.heading_sigma_rad, kDegreesPerRadian, "deg of heading"),
                        place.found);
    text += corrections_text(fmt::format("Sensor {}: ", i + 1), place.depth, place.camera);
  }
  for (const std::string& note : c.notes) text += fmt::format("Note: {}\n", note);
  return text;
}

}  // namespace turnscan
