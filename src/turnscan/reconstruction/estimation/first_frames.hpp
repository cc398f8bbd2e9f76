#pragma once
// Buffers the first frames of a scan until its scale can be estimated.

#include <turnscan/reconstruction/estimation/scan_estimate.hpp>
#include <turnscan/reconstruction/frame_batch.hpp>

namespace turnscan::estimation {

class FirstFrames {
 public:
  /// rays: per sensor; rays and header must outlive it. colored: keep the colour images.
  FirstFrames(const SequenceHeader& header, const std::vector<RayTable>& rays,
              const CropOptions& crop, bool colored);

  /// Reads as many of the frames as are missing, and keeps them. Returns their number. Fails with
  /// the errors of read and points_of, and with kCancelled; then none is kept.
  Result<std::size_t> keep(std::span<const PosedFrame> frames, const FrameReader& read,
                           const RunContext& context);

  /// Whether there are enough frames for an estimate; profiles of line scanners need more.
  Result<bool> enough();

  /// To be called while nothing stands on the platter yet: requires more frames for an estimate,
  /// and discards the oldest if there are many.
  void ask_for_more();

  /// Fails as estimate_scan() does.
  Result<ScanEstimate> estimate() const;

  const std::vector<Frame>& frames() const { return frames_; }
  /// In the order of frames(), which their positions refer to.
  std::vector<PosedFrame> posed_frames() const;
  std::size_t discarded() const { return discarded_; }

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
