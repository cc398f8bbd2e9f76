#pragma once
// Stores the last calibration of a device, and checks whether it is still valid: the same rig scans
// many objects.

#include <filesystem>
#include <optional>
#include <string>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// Path of a device's stored calibration: turnscan/calibrations/IDENTITY.json in the folder named
/// by XDG_STATE_HOME, else in ~/.local/state. identity: of SourceInfo. Fails with kNotFound if
/// there is no home.
Result<std::filesystem::path> kept_calibration_file(const std::string& identity);

/// nullopt if none is stored. Fails as read_calibration.
Result<std::optional<Calibration>> kept_calibration(const std::string& identity);

/// Stores the pose of the table; angles of frames and the start of the rotation belong to one
/// recording and are left out. Creates the folder. Fails as write_calibration.
Result<> keep_calibration(const std::string& identity, const Calibration& calibration);

/// Calibration::made_at for a calibration of a device made now: this machine's date, or that of the
/// recording that is replayed.
std::string date_of_calibration(const SourceInfo& device);

/// Comparison of the table with its calibration.
struct RigCheck {
  bool moved = false;
  /// Deviation of the observed platter from the calibration; NaN if it was not seen well enough.
  double height_m = std::numeric_limits<double>::quiet_NaN();  ///< along the axis
  double tilt_rad = std::numeric_limits<double>::quiet_NaN();
  double shift_m = std::numeric_limits<double>::quiet_NaN();  ///< across the axis
  std::string text;                                           ///< one sentence for the user
};

/// Thresholds above which a rig counts as moved (or four standard deviations if that is larger).
inline constexpr double kMovedHeight_m = 0.0025, kMovedTilt_rad = 0.0105, kMovedShift_m = 0.004;

/// Compares a platter that was found with the calibration.
RigCheck compare_platter(const DetectedPlatter& now, const Calibration& calibration);

/// Detects the platter in an average of a few frames (an object may be on it). If its rim is not
/// visible, only its height is compared; if no platter is found at the calibrated pose, the rig has
/// moved. Fails with kCancelled, and kFormat if the calibration has no axis.
Result<RigCheck> check_rig(const AveragedScan& scan, const Calibration& calibration,
                           const RunContext& context);

}  // namespace turnscan
