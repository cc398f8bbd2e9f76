#pragma once
// The angles that a recording states.

#include <turnscan/core/frame.hpp>
#include <vector>

namespace turnscan::checks {

/// Per frame its own angle, or that of the recorded speed, radians; NaN where there is neither, for
/// frames that are not whole and for sensors other than the first.
std::vector<double> recorded_angles(const FrameSequence& sequence);

}  // namespace turnscan::checks
