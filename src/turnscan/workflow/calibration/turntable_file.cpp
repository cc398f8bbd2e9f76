#include <turnscan/workflow/calibration/turntable_file.hpp>

#include <turnscan/core/sequence_views.hpp>
#include <turnscan/recording/calibration_file.hpp>

namespace turnscan {

Result<std::unique_ptr<FrameSequence>> with_turntable(const FrameSequence& sequence,
                                                      const std::string& path) {
  if (path.empty()) return std::make_unique<SequenceView>(sequence);
  TURNSCAN_ASSIGN(const Calibration calibration, read_calibration(path));
  return with_calibration(sequence, calibration);
}

}  // namespace turnscan
