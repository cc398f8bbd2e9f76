#pragma once
// Slips and stops of the table, found by comparing frames that are some degrees apart.

#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::checks {

/// The table turned by `size_rad` more than expected (negative: by less).
struct MotorEvent {
  double time_s = 0.0;    ///< when it began
  double size_rad = 0.0;  ///< signed as the angles are
  double lasts_s = 0.0;   ///< of a stop; 0: it slipped, at one moment
};

struct MotorObservation {
  std::vector<MotorEvent> events;  ///< in order of time
  double observed_share = 0.0;     ///< of the time, in which an event would have been seen
  double speed_rad_s = 0.0;        ///< median of what was seen
};

/// How far the table turns between two frames is searched for within 70 degrees about what is
/// expected, by how well one frame's points then fit the other one's surface; several pairs of
/// frames of one stretch of time have to agree on it. It counts where they fit clearly better
/// than with the expected turn. `state` says where the axis is; `expected`: angle of each frame, or
/// empty: a constant speed, the median of what is seen near `speed_rad_s`. from_s, to_s: the part
/// of the recording that is searched, by the times of its frames. Fails with kCancelled.
Result<MotorObservation> find_motor_events(const motion::MotionData& data,
                                           const motion::MotionState& state,
                                           const std::vector<double>& expected, double speed_rad_s,
                                           double from_s, double to_s, const RunContext& context);

}  // namespace turnscan::checks
