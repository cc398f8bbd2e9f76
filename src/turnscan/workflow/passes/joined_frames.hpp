#pragma once
// Presents passes of one or more recordings as one sequence, which reconstruct() fuses.

#include <turnscan/core/sequence_views.hpp>
#include <turnscan/reconstruction/pass_placement.hpp>
#include <vector>

namespace turnscan {

/// One pass of a sequence, which must outlive it.
struct SequencePass {
  const FrameSequence* frames = nullptr;  ///< posed on their table
  std::uint32_t pass = 0;                 ///< value of FrameInfo::pass in the sequence
  std::optional<double> speed_rad_s;      ///< stated; see frame_poses()
};

/// The passes from which the sequence has frames that were not dropped, ascending.
std::vector<std::uint32_t> passes_of(const FrameSequence& sequence);

/// Concatenates passes: passes are renumbered from 0, and so are frames if they come from several
/// sequences; each frame keeps its pose of the original sequence. The header lists the sensors of
/// all sequences. Fails as frame_poses() does.
Result<SequenceView> join_passes(const std::vector<SequencePass>& passes);

}  // namespace turnscan
