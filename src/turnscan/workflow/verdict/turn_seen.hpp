#pragma once
// Directions from which the frames of a scan view the table.

#include <optional>
#include <turnscan/core/frame.hpp>

namespace turnscan {

struct TurnSeen {
  /// Share of a full turn, 0 to 1: directions less than 20 degrees from a frame's.
  double share = 0.0;
  double turns = 0.0;           ///< total rotation of the table
  double widest_gap_rad = 0.0;  ///< between neighbouring directions, regardless of the 20 degrees
};

/// From the frames that were not dropped; nullopt if their poses are not known.
std::optional<TurnSeen> turn_seen(const FrameSequence& frames, std::optional<double> speed_rad_s);

}  // namespace turnscan
