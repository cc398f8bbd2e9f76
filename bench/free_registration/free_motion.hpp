#pragma once
// Poses by free registration, as the thesis tried and discarded (3.6): for comparison with
// calibration from motion.

#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>
#include "bench/free_registration/free_registration.hpp"

namespace turnscan {

enum class FreeScheme {
  kConsecutive,  ///< each frame onto the one before it, as that was placed
  kGlobal        ///< each frame onto all others, as the calibration places them
};

/// T_table_sensor of every frame, from T_table_sensor `start` (frame_poses) on. What stands on the
/// platter is registered, at most 1500 points a frame; a frame that does not converge, or shows
/// less than 20 points, stays where its predecessor's correction or the calibration has it.
/// Fails with kInvalidOption when start does not fit the frames, kCancelled, and what reading
/// fails with.
Result<std::vector<Pose>> register_frames_freely(const FrameSequence& sequence,
                                                 const std::vector<Pose>& start, FreeMethod method,
                                                 FreeScheme scheme, const RunContext& context);

}  // namespace turnscan
