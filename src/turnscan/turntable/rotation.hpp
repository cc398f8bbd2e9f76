#pragma once
// Pose of the sensor for each frame of a sequence, in the table frame that turns with the platter.

#include <optional>
#include <turnscan/core/frame.hpp>

namespace turnscan {

/// Source of the poses.
enum class PoseSource { kPoses, kAngles, kTimesAndSpeed };

struct FramePoses {
  std::vector<Pose> T_table_sensor;  ///< one per frame, in order; the table's rotation is
                                     ///< compensated
  PoseSource source = PoseSource::kPoses;
};

/// T_table_sensor of every frame: its own pose if it has one; else Ry(-angle) * the sensor's pose,
/// with the frame's angle, or with angle = speed * (t - t0) (thesis eq. 3.8), t0 being the time of
/// the first frame. A speed_rad_s given here takes precedence over recorded angles and speed for
/// frames that have a time.
/// Fails with kMissingData, naming the frame and what would help, if none of these is known; also
/// for a frame of another stretch than the first one, unless it has an angle and no speed is given.
Result<FramePoses> frame_poses(const SequenceHeader& header, const std::vector<FrameInfo>& frames,
                               std::optional<double> speed_rad_s);

/// The same for a stream of frames; t0 is the time of the first frame that is passed in.
class FramePoser {
 public:
  /// header must outlive it.
  FramePoser(const SequenceHeader& header, std::optional<double> speed_rad_s);
  Result<Pose> operator()(const FrameInfo& frame);
  PoseSource source() const { return source_; }

 private:
  const SequenceHeader* header_;
  std::optional<double> speed_rad_s_;
  std::optional<FrameInfo> first_;
  std::vector<std::optional<Pose>> sensors_;
  PoseSource source_ = PoseSource::kPoses;
};

}  // namespace turnscan
