#pragma once
// When the table starts, stops and stands.

#include <turnscan/turntable/motion/angle_prior.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>

namespace turnscan::motion {

/// Marks the frames in prior.transient: where the speed over about a second is far from the median,
/// the table starts or stops. Sets prior.speed_rad_s to the median. The frames must have times.
/// Returns whether any was marked.
bool find_transients(const MotionData& data, const MotionState& state, AnglePrior& prior);

/// Marks the frames in prior.still: how long the table stands before it starts and after it
/// stopped, until an angle is farther from the mean of those before than it can be by chance. What
/// the table turns by meanwhile is less than can be seen. Needs prior.transient.
void find_standstills(const MotionState& state, AnglePrior& prior);

}  // namespace turnscan::motion
