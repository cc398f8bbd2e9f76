#pragma once
// Frames in which something stands between the sensor and the object.

#include <turnscan/turntable/placement/pair_constraints.hpp>

namespace turnscan::placement {

/// Keyframes with clearly more points than the others in space that their neighbours see to be
/// free, such as those on a hand or an arm.
std::vector<std::size_t> hidden_frames(const Keyframes& frames, const std::vector<Pose>& poses);

/// Removes those keyframes.
void leave_out(Keyframes& frames, const std::vector<std::size_t>& hidden);

}  // namespace turnscan::placement
