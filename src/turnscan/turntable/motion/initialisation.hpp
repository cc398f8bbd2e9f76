#pragma once
// Where least squares start: axis, angles and what is known of them beforehand.

#include <turnscan/turntable/motion/angle_prior.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>

namespace turnscan::motion {

/// What the frames say of their angles before they are looked at.
enum class AngleSource { kTimes, kAngles, kNothing };

struct InitialMotion {
  MotionState state;
  AnglePrior prior;
  AngleSource source = AngleSource::kTimes;
  /// Of somebody or the recording's turntable, for where the object does not show its turn.
  std::optional<double> known_speed_rad_s;
};

/// The candidate axis (candidate_axes) about which the frames fit best after a coarse solution,
/// with angles from the frames' own (of either sign), from their times or from trying all turns.
/// header: turntable whose speed is known.
/// Fails with kMissingData when about no axis a speed is seen or known, kCancelled.
Result<InitialMotion> initialise_motion(const MotionData& data, const SequenceHeader& header,
                                        const FromMotionOptions& options,
                                        const RunContext& context);

}  // namespace turnscan::motion
