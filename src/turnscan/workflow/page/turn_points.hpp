#pragma once

#include <turnscan/core/frame.hpp>
#include <vector>

namespace turnscan {

/// A frame's time and angle.
struct TurnPoint {
  double time_s = 0.0, angle_rad = 0.0;
};

/// Of the frames of the first sensor and pass that have both, sorted by time.
std::vector<TurnPoint> turn_of(const FrameSequence& sequence);

}  // namespace turnscan
