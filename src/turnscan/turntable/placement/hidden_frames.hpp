#pragma once
// Frames in which something stands between the sensor and the object.

#include <turnscan/turntable/placement/pair_constraints.hpp>

namespace turnscan::placement {

/// Which keyframes show, clearly more than the others do, points where their neighbours see through
/// to the object or past it: a hand, an arm.
std::vector<std::size_t> hidden_frames(const Keyframes& frames, const std::vector<Pose>& poses);

/// Without those of the keyframes.
void leave_out(Keyframes& frames, const std::vector<std::size_t>& hidden);

}  // namespace turnscan::placement
