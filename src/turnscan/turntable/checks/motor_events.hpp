#pragma once
// Detects slips and stops of the table by comparing frames that are some degrees apart.

#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::checks {

/// The table turned by `size_rad` more than expected (by less if negative).
struct MotorEvent {
  double time_s = 0.0;    ///< when it began
  double size_rad = 0.0;  ///< same sign as the angles
  double lasts_s = 0.0;   ///< duration of a stop; 0 for a slip, which is instantaneous
};

struct MotorObservation {
  std::vector<MotorEvent> events;  ///< in order of time
  double observed_share = 0.0;     ///< share of the time in which an event would have been detected
  double speed_rad_s = 0.0;        ///< median of the observed speeds
};

/// Searches for the rotation between two frames within 70 degrees of the expected one, by how well
/// the points of one frame then fit the surface of the other; several pairs of frames from one
/// stretch of time must agree on it. An event counts if the frames fit clearly better than with the
/// expected rotation. `state` gives the axis. `expected`: angle of each frame, or empty for a
/// constant speed, the median of those observed near `speed_rad_s`. from_s, to_s: the part of the
/// recording that is searched, by the times of its frames. Fails with kCancelled.
Result<MotorObservation> find_motor_events(const motion::MotionData& data,
                                           const motion::MotionState& state,
                                           const std::vector<double>& expected, double speed_rad_s,
                                           double from_s, double to_s, const RunContext& context);

}  // namespace turnscan::checks
