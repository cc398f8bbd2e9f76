#pragma once
// Slips and stops of the table, looked for between frames that are some degrees apart. Internal to
// turntable: not installed.

#include <turnscan/turntable/motion_solve.hpp>

namespace turnscan::detail {

/// The table turned by `size_rad` more than expected (less: negative).
struct MotorEvent {
  double time_s = 0.0;    ///< when it began
  double size_rad = 0.0;  ///< signed as the angles are
  double lasts_s = 0.0;   ///< of a stop; 0: it slipped, at one moment
};

struct MotorWatch {
  std::vector<MotorEvent> events;  ///< in order of time
  double told = 0.0;               ///< share of the time in which an event would have been seen
  double speed_rad_s = 0.0;        ///< median of what was seen
};

/// How far the table turns between two frames is searched for within 70 degrees about what is
/// expected, by how well one frame's points then fit the other one's surface; several pairs of
/// frames of one stretch of time have to agree on it. It counts where they fit clearly better
/// than with the expected turn. `state` says where the axis is; `expected`: angle of each frame, or
/// empty: a constant speed, the median of what is seen near `speed_rad_s`. Looks between two
/// times of the frames. Fails with kCancelled.
Result<MotorWatch> watch_motor(const MotionData& data, const MotionState& state,
                               const std::vector<double>& expected, double speed_rad_s,
                               double from_s, double to_s, const RunContext& context);

}  // namespace turnscan::detail
