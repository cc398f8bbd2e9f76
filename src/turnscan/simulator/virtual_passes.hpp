#pragma once
// Several virtual scans as one sequence of passes, between which the object is repositioned.

#include <turnscan/simulator/virtual_scan.hpp>

namespace turnscan {

/// The frames of the scans in order. Those of scan k have its pass number; indices and times
/// continue (a second after the last frame of the previous pass), angles restart with each pass.
class VirtualPasses : public FrameSequence {
 public:
  /// At least one scan, all with the same scanners, turntable and recorded calibration: the header
  /// is the first one's. Throws std::invalid_argument without any.
  explicit VirtualPasses(std::vector<VirtualScan> scans);

  const SequenceHeader& header() const override;
  const std::vector<FrameInfo>& frames() const override;
  Result<Frame> read(std::size_t position) const override;

  std::size_t count() const { return scans_.size(); }
  const VirtualScan& pass(std::size_t k) const { return scans_.at(k); }
  /// The scan of a frame, and its position there. Precondition: the frame exists.
  std::pair<std::size_t, std::size_t> place_of(std::size_t position) const;
  /// As in VirtualScan, over all passes.
  std::array<std::uint64_t, 10> tally(std::size_t scanner) const;

 private:
  std::vector<VirtualScan> scans_;
  std::vector<std::size_t> first_;  ///< position of each scan's first frame
  std::vector<FrameInfo> frames_;
};

}  // namespace turnscan
