#pragma once
// The last calibration of a device, and whether it still holds: the same rig scans many objects.

#include <filesystem>
#include <optional>
#include <string>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// Where the calibration of a device is kept: turnscan/calibrations/IDENTITY.json in the folder
/// that XDG_STATE_HOME names, else in ~/.local/state. identity: of SourceInfo. Fails with kNotFound
/// when there is no home.
Result<std::filesystem::path> kept_calibration_file(const std::string& identity);

/// nullopt when none is kept. Fails as read_calibration.
Result<std::optional<Calibration>> kept_calibration(const std::string& identity);

/// Keeps where the table is; angles of frames and when it began to turn are left out, they were of
/// one recording. Makes the folder. Fails as write_calibration.
Result<> keep_calibration(const std::string& identity, const Calibration& calibration);

/// Calibration::made_at of a calibration made now of a device: this machine's date, or that of the
/// recording that is replayed.
std::string date_of_calibration(const SourceInfo& device);

/// How the table stands against its calibration.
struct RigCheck {
  bool moved = false;
  /// Of the platter now against the calibration; NaN where it was not seen well enough.
  double height_m = std::numeric_limits<double>::quiet_NaN();  ///< along the axis
  double tilt_rad = std::numeric_limits<double>::quiet_NaN();
  double shift_m = std::numeric_limits<double>::quiet_NaN();  ///< across the axis
  std::string text;                                           ///< one sentence for people
};

/// From this on a rig counts as moved (or four standard deviations, where they are more).
inline constexpr double kMovedHeight_m = 0.0025, kMovedTilt_rad = 0.0105, kMovedShift_m = 0.004;

/// Looks for the platter anew in an average of a few frames (an object may stand on it). Where its
/// rim is not seen, its height alone is compared; where no platter is seen at the place of the
/// calibration, the rig has moved. Fails with kCancelled, and kFormat when the calibration has no
/// axis.
Result<RigCheck> check_rig(const AveragedScan& scan, const Calibration& calibration,
                           const RunContext& context);

}  // namespace turnscan
