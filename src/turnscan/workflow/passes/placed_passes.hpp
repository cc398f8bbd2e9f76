#pragma once
// The passes of a recording, brought together.

#include <turnscan/reconstruction/options.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>

namespace turnscan {

/// For reconstruct(), in the frame of the first pass's table.
struct PlacedPasses {
  JoinedFrames frames;  ///< refer to the sequence
  std::vector<PassPlacement> placements;
};

/// All passes of a sequence whose frames are calibrated, as stated. Fails with kInvalidOption when
/// a pass but the first is not stated, is not there or is stated twice, or when the options choose
/// one pass; and as frame_poses() does.
Result<PlacedPasses> place_passes(const FrameSequence& sequence,
                                  const std::vector<PassPose>& stated,
                                  const ReconstructOptions& options);

}  // namespace turnscan
