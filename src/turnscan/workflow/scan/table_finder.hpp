#pragma once

#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <vector>

namespace turnscan::workflow {

/// Determines the pose of the turntable before a scan begins: from the file that states it, from
/// the stored calibration of this device, or from the platter.
class TableFinder {
 public:
  /// Stores its findings in setup.header; setup and notes must outlive it. setup: opened. notes:
  /// receives sentences for the user.
  TableFinder(CaptureSetup& setup, std::vector<std::string>& notes)
      : setup_(setup), notes_(notes) {}

  /// Consumes the first frames of a started source. Checks the poses stated by a file, and fails
  /// with kMissingData if a sensor or the table has moved since. Returns whether the poses of all
  /// sensors are known; a detected platter suffices to find the object but does not count as known.
  /// Also fails with kCancelled and as the source does.
  Result<bool> find(FrameSource& source, const RunContext& context);

 private:
  Result<> check_stated(FrameSource& source, const AveragedScan& first,
                        const RunContext& context) const;
  Result<> check_sensor(const AveragedScan& scan, const Calibration& calibration,
                        const std::string& who, const RunContext& context) const;
  Result<bool> take_kept(const FrameSource& source, const AveragedScan& scan,
                         const RunContext& context);
  Result<> detect(const FrameSource& source, const AveragedScan& scan, const RunContext& context);
  void set_table(const TurntableInfo& table, const std::string& made_at);

  CaptureSetup& setup_;
  std::vector<std::string>& notes_;
};

}  // namespace turnscan::workflow
