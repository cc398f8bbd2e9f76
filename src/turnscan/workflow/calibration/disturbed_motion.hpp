#pragma once
// Finds disturbances of a recording whose turntable was calibrated from motion.

#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>

namespace turnscan::workflow {

/// Disturbances of the recording, relative to its calibration or a stated speed; empty if the
/// frames' poses are not known. Frames that have poses of their own are not questioned. Fails as
/// find_disturbances().
Result<Placement> disturbances_of(const FrameSequence& calibrated,
                                  std::optional<double> stated_speed_rad_s, PlatterMemory* memory,
                                  const RunContext& context);

/// Inserts the slips that the calibration's angles already follow before the other disturbances.
void put_slips_first(const Calibration& calibration, const FrameSequence& recording,
                     Placement& placement);

/// Whether every frame has a pose of its own.
bool has_poses(const FrameSequence& sequence);

/// Looks for disturbances in the recording as posed by `found`, its calibration from motion. If the
/// object moved or the sensor was knocked, a calibration that assumes one rigid rotation of all
/// frames is wrong by up to the same amount: it is replaced by the calibration of the longest
/// undisturbed interval if that has at least 0.4 of a turn and 16 frames; else its standard
/// deviations are widened to the size of the disturbance. A wobble widens them, too. The slips that
/// its angles follow come first. Recordings of several sensors or passes are not examined. Fails
/// with kCancelled, and as reading does.
Result<Placement> settle_disturbances(const FrameSequence& recording,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      Calibration& found, PlatterMemory* memory,
                                      const RunContext& context);

}  // namespace turnscan::workflow
