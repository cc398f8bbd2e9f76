#pragma once
// What disturbed a recording of which the turntable was found from motion.

#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>

namespace turnscan::workflow {

/// What disturbed the recording, as its calibration or a stated speed places it; empty where
/// nothing says where the frames are. Poses of their own are not questioned. Fails as
/// find_disturbances().
Result<Placement> disturbances_of(const FrameSequence& calibrated,
                                  std::optional<double> stated_speed_rad_s, PlatterMemory* memory,
                                  const RunContext& context);

/// Puts the slips that the calibration's angles follow before what else disturbed the recording.
void put_slips_first(const Calibration& calibration, const FrameSequence& recording,
                     Placement& placement);

/// Whether every frame has a pose of its own.
bool has_poses(const FrameSequence& sequence);

/// Looks for disturbances in the recording as `found`, its calibration from motion, places it.
/// Where the object moved or the sensor was knocked, a calibration that takes all frames for views
/// of one rigid turn is wrong by up to as much: it is replaced by that of the longest time in
/// between, if at least 0.4 of a turn and 16 frames of it remain, else its deviations are widened
/// to the disturbance. A wobble widens them, too. The slips that its angles follow come first.
/// Several sensors and passes are not looked at. Fails with kCancelled, and what reading fails
/// with.
Result<Placement> settle_disturbances(const FrameSequence& recording,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      Calibration& found, PlatterMemory* memory,
                                      const RunContext& context);

}  // namespace turnscan::workflow
