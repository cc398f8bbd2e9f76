#include "turntable_file.hpp"

#include <turnscan/recording/calibration_file.hpp>

namespace turnscan::cli {

namespace {

class Same : public FrameSequence {
 public:
  explicit Same(const FrameSequence& sequence) : sequence_(sequence) {}
  const SequenceHeader& header() const override { return sequence_.header(); }
  const std::vector<FrameInfo>& frames() const override { return sequence_.frames(); }
  Result<Frame> read(std::size_t position) const override { return sequence_.read(position); }

 private:
  const FrameSequence& sequence_;
};

}  // namespace

Result<std::unique_ptr<FrameSequence>> with_turntable(const FrameSequence& sequence,
                                                      const std::string& path) {
  if (path.empty()) return std::make_unique<Same>(sequence);
  TURNSCAN_ASSIGN(const Calibration calibration, read_calibration(path));
  return with_calibration(sequence, calibration);
}

}  // namespace turnscan::cli
