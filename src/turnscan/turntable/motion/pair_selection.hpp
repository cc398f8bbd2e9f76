#pragma once
// Selects the pairs of frames that are compared.

#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// Partners for each frame among the key frames: close in angle, some tens of degrees away, and a
/// whole number of turns away.
std::vector<FramePair> select_pairs(const MotionData& data, const std::vector<double>& angle,
                                    bool all_frames);

}  // namespace turnscan::motion
