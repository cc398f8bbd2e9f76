#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/utc_time.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMinReturns = 1000;

Result<fs::path> state_folder() {
  // The specification requires relative paths to be ignored.
  if (const char* set = std::getenv("XDG_STATE_HOME"); set != nullptr && *set == '/')
    return fs::path(set);
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".local" / "state";
  return fail(ErrorCode::kNotFound,
              "calibrations are kept in the home folder, and HOME is not set; set XDG_STATE_HOME");
}

double at_least(double limit, double sigma) {
  return std::isfinite(sigma) ? std::max(limit, 4.0 * sigma) : limit;
}

/// Without the rim: compares the height of the surface seen at the platter's position.
RigCheck compare_height(const AveragedScan& scan, const Calibration& calibration,
                        const Pose& T_table_sensor, const std::string& why) {
  RigCheck check;
  const double radius = calibration.table.radius_m.value_or(0.1);
  std::vector<Vec3f> p_table;
  for (const Vec3f& p : points_of(scan).cloud.points)
    p_table.push_back((T_table_sensor * p.cast<double>()).cast<float>());
  const PlatterReturns returns = measure_platter(p_table, radius);
  if (returns.count < kMinReturns) {
    check.moved = true;
    check.text = "the rig has moved: no platter is seen where it was calibrated; calibrate anew";
    return check;
  }
  check.height_m = returns.height_m;
  check.moved = std::abs(check.height_m) > kMovedHeight_m;
  check.text =
      fmt::format("{}: the platter lies {:.1f} mm {} than calibrated ({}){}",
                  check.moved ? "the rig has moved" : "the rig stands as calibrated",
                  1e3 * std::abs(check.height_m), check.height_m < 0.0 ? "lower" : "higher", why,
                  check.moved ? "; calibrate anew" : "");
  return check;
}

}  // namespace

Result<fs::path> kept_calibration_file(const std::string& identity) {
  TURNSCAN_ASSIGN(const fs::path folder, state_folder());
  return folder / "turnscan" / "calibrations" / (identity + ".json");
}

Result<std::optional<Calibration>> kept_calibration(const std::string& identity) {
  TURNSCAN_ASSIGN(const fs::path file, kept_calibration_file(identity));
  TURNSCAN_ASSIGN(const bool there, file::is_there(file));
  if (!there) return std::optional<Calibration>();
  TURNSCAN_ASSIGN(Calibration calibration, read_calibration(file));
  return std::optional<Calibration>(std::move(calibration));
}

Result<> keep_calibration(const std::string& identity, const Calibration& calibration) {
  TURNSCAN_ASSIGN(const fs::path file, kept_calibration_file(identity));
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    return fail_at(file.parent_path().string(), ErrorCode::kIo,
                   "the folder of calibrations cannot be made ({}); set XDG_STATE_HOME",
                   error.message());
  Calibration kept = calibration;
  kept.angles_rad.clear();
  kept.angle_sigma_rad.clear();
  kept.angles_found.clear();
  kept.start_s.reset();
  return write_calibration(file, kept);
}

std::string date_of_calibration(const SourceInfo& device) {
  if (device.driver != "replay") return utc_text(utc_now_s());
  const auto started = device.settings.find(kStartedAt);
  return started != device.settings.end() && utc_seconds(started->second) ? started->second : "";
}

RigCheck compare_platter(const DetectedPlatter& now, const Calibration& calibration) {
  const TurntableInfo& then = calibration.table;
  const Vec3d axis = then.axis.normalized();
  const Vec3d offset = now.center_m - then.center_m;
  RigCheck check;
  check.height_m = offset.dot(axis);
  check.shift_m = (offset - check.height_m * axis).norm();
  check.tilt_rad = std::acos(std::clamp(now.axis.normalized().dot(axis), -1.0, 1.0));
  check.moved = std::abs(check.height_m) > at_least(kMovedHeight_m, now.height_sigma_m) ||
                check.tilt_rad > at_least(kMovedTilt_rad, now.axis_sigma_rad) ||
                check.shift_m > at_least(kMovedShift_m, now.center_sigma_m);
  check.text = fmt::format(
      "{}: the platter lies {:.1f} mm {}, {:.1f} mm aside and tilted by {:.2f} deg against the "
      "calibration{}",
      check.moved ? "the rig has moved" : "the rig stands as calibrated",
      1e3 * std::abs(check.height_m), check.height_m < 0.0 ? "lower" : "higher",
      1e3 * check.shift_m, check.tilt_rad / kRadiansPerDegree,
      check.moved ? "; calibrate anew" : "");
  return check;
}

Result<RigCheck> check_rig(const AveragedScan& scan, const Calibration& calibration,
                           const RunContext& context) {
  TURNSCAN_ASSIGN(const Pose T_table_sensor, table_from_sensor(calibration.table));
  DetectOptions options;
  options.radius_m = calibration.table.radius_m;
  const auto found = detect_platter(scan, options, context);
  if (found) return compare_platter(*found, calibration);
  if (found.error().code == ErrorCode::kCancelled) return tl::unexpected<Error>(found.error());
  return compare_height(scan, calibration, T_table_sensor, "its rim is not seen well enough");
}

}  // namespace turnscan
