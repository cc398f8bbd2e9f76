#pragma once
// Exhaustive search for the axis of scans with stated table angles.

#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <vector>

namespace turnscan::motion {

struct AxisTrial {
  MotionState state;
  double sign = 1.0;  ///< of the stated angles
  double cost = 1.0;  ///< 0 to 1: mean over the samples that were compared
};

/// At most `most` axes, lowest cost first and far apart, about which point scans some tens of
/// degrees apart are roughly aligned. Tries axes up to 60 degrees from the scans' y axis, all
/// positions around the visible scene, and both signs of the angles; the scanner's position need
/// not be known. angle_rad: of each frame of `data` since the first, as stated. Fails with
/// kCancelled.
Result<std::vector<AxisTrial>> search_axes(const MotionData& data,
                                           const std::vector<double>& angle_rad, std::size_t most,
                                           const RunContext& context);

}  // namespace turnscan::motion
