#pragma once
// From which sides the frames of a scan look at the table.

#include <optional>
#include <turnscan/core/frame.hpp>

namespace turnscan {

struct TurnSeen {
  double share = 0.0;  ///< of a full turn, 0 to 1: headings less than 20 degrees from a frame's
  double turns = 0.0;  ///< by which the table turned in all
  double widest_gap_rad = 0.0;  ///< between neighbouring headings, whatever their reach
};

/// Of the frames that were not dropped; nullopt where nothing says where they were.
std::optional<TurnSeen> turn_seen(const FrameSequence& frames, std::optional<double> speed_rad_s);

}  // namespace turnscan
