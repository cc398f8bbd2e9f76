#pragma once
// Initial values of the least squares: axis, angles and their prior.

#include <turnscan/turntable/motion/angle_prior.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>

namespace turnscan::motion {

/// What the frames state about their angles.
enum class AngleSource { kTimes, kAngles, kNothing };

struct InitialMotion {
  MotionState state;
  AnglePrior prior;
  AngleSource source = AngleSource::kTimes;
  /// From the user or the recording's turntable, used if the object does not show its rotation.
  std::optional<double> known_speed_rad_s;
};

/// The candidate axis (candidate_axes) about which the frames fit best after a coarse solution,
/// with angles from the frames' own (of either sign), from their times or from trying all
/// rotations. header: turntable whose speed is known.
/// Fails with kMissingData if no speed is observed about any axis and none is known, with
/// kCancelled.
Result<InitialMotion> initialise_motion(const MotionData& data, const SequenceHeader& header,
                                        const FromMotionOptions& options,
                                        const RunContext& context);

}  // namespace turnscan::motion
