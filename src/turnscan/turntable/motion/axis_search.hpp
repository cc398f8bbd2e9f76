#pragma once
// Where the axis of scans lies that were told how far the table had turned: all places are tried.

#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <vector>

namespace turnscan::motion {

struct AxisTrial {
  MotionState state;
  double sign = 1.0;  ///< of the told angles
  double cost = 1.0;  ///< 0 to 1: mean over the samples that were compared
};

/// At most `most` axes, of lowest cost first and far apart, about which scans of points that lie
/// some tens of degrees apart are roughly aligned. Tried are axes up to 60 degrees from the scans'
/// y axis, all places around what is seen and both signs of the angles; where the scanner stands
/// need not be known. angle_rad: of each frame of `data` since the first, as told. Fails with
/// kCancelled.
Result<std::vector<AxisTrial>> search_axes(const MotionData& data,
                                           const std::vector<double>& angle_rad, std::size_t most,
                                           const RunContext& context);

}  // namespace turnscan::motion
