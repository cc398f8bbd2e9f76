#pragma once

#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <vector>

namespace turnscan::workflow {

/// Finds where the turntable stands before a scan begins: from the file that states it, from the
/// calibration that was kept of this device, or from the platter.
class TableFinder {
 public:
  /// Puts what it finds into setup.header; both must outlive it. setup: opened. notes: gets
  /// sentences for people.
  TableFinder(CaptureSetup& setup, std::vector<std::string>& notes)
      : setup_(setup), notes_(notes) {}

  /// The first frames of a started source are taken. Checks the places that a file states, and
  /// fails with kMissingData when a sensor or the table has moved since. Whether the places of all
  /// sensors are known is the result; a platter that was seen is good for finding the object, but
  /// not known. Fails also with kCancelled and as the source does.
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
