#pragma once
// The angles that a recording states.

#include <turnscan/core/frame.hpp>
#include <vector>

namespace turnscan::checks {

/// Angle of each frame in radians: its own, or else from the recorded speed. NaN if neither is
/// known, for frames whose status is not kOk, and for sensors other than the first.
std::vector<double> recorded_angles(const FrameSequence& sequence);

}  // namespace turnscan::checks
