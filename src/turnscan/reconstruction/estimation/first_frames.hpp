#pragma once
// The first frames of a scan wait here until its scale can be estimated.

#include <turnscan/reconstruction/estimation/scan_estimate.hpp>
#include <turnscan/reconstruction/frame_batch.hpp>

namespace turnscan::estimation {

class FirstFrames {
 public:
  /// rays: per sensor; these and the header must outlive it. colored: keep the colour images.
  FirstFrames(const SequenceHeader& header, const std::vector<RayTable>& rays,
              const CropOptions& crop, bool colored);

  /// Reads as many of the frames as are missing, and keeps them. Returns how many. Fails with what
  /// read and points_of fail with, kCancelled; then none is kept.
  Result<std::size_t> keep(std::span<const PosedFrame> frames, const FrameReader& read,
                           const RunContext& context);

  /// Whether as many are there as an estimate needs: of profiles of line scanners, more.
  Result<bool> enough();

  /// Nothing stands on the platter yet: an estimate needs more frames, and the oldest of many are
  /// discarded.
  void ask_for_more();

  /// Fails as estimate_scan() does.
  Result<ScanEstimate> estimate() const;

  const std::vector<Frame>& frames() const { return frames_; }
  /// In the order of frames(), which is what their positions count.
  std::vector<PosedFrame> posed_frames() const;
  std::size_t discarded() const { return discarded_; }
  void clear();

 private:
  const SequenceHeader& header_;
  const std::vector<RayTable>& rays_;
  CropOptions crop_;
  bool colored_;
  std::size_t needed_;
  std::vector<Frame> frames_;
  std::vector<Pose> poses_;  ///< T_table_sensor of each
  std::size_t discarded_ = 0;
};

}  // namespace turnscan::estimation
