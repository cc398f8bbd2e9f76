#pragma once
// What fine relief does to the axis that motion shows.

#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// Standard deviation of a shift of the axis along the view, metres, at the angles of a state.
///
/// Seen at a slant, the crests of a fine relief (a gear's teeth, knurling, fur) hide its hollows,
/// so that the surface seems to lie farther out than seen head-on. If it does so by s times one
/// minus the cosine of incidence, every pair of frames fits exactly as if the axis lay s farther
/// from the sensor, whatever the shape: motion alone cannot tell the two apart. The relief is
/// measured where smoothing has removed it: what it left over agrees between neighbouring frames,
/// as noise does not. 0 for points, and if frames have too little in common.
double view_shift_sigma_m(const MotionData& data, const MotionState& state);

}  // namespace turnscan::motion
