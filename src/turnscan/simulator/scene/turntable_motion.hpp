#pragma once
// Motion of the platter during a recording: the time of each frame, and the platter's pose then.

#include <cstdint>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan {

struct MotionOptions {
  /// Instants at which every scanner takes a frame. nullopt: 920, or with a speed as many as the
  /// turns take at that speed.
  std::optional<int> frames;
  double turns = 1.0;  ///< over which the frames are spread; negative: clockwise
  double fps = 30.0;   ///< frames per second
  /// Of the platter at full speed. Takes precedence over turns if frames are given, too.
  std::optional<double> speed_rad_s;
  double start_delay_s = 0.0;  ///< at rest before it starts
  double start_ramp_s = 0.0;   ///< uniform acceleration from rest to full speed
  double stop_ramp_s = 0.0;    ///< from full speed to rest, ending with the recording
  double halt_at_s = 0.0;      ///< when the platter stops abruptly,
  double halt_s = 0.0;         ///< and for how long it stands before it continues; 0: never
  double slip_at_s = 0.0;      ///< when it jumps,
  double slip_rad = 0.0;       ///< and the additional rotation of the jump; 0: never
  double ripple = 0.0;         ///< relative amplitude of the speed's variation
  double ripple_cycles = 7.0;  ///< of the ripple in one turn
  double wobble_rad = 0.0;     ///< angle between the axis and its mean
  double wobble_cycles = 2.0;  ///< of the axis about its mean in one turn
  double runout_m = 0.0;       ///< distance of the platter's centre from its mean
  double runout_cycles = 1.0;  ///< of the centre about its mean in one turn
  double dropped = 0.0;        ///< share of the frames that are lost, chosen at random
};

/// speed_name: used if "speed" already has another meaning.
OptionTable describe(MotionOptions& options, const std::string& speed_name = "speed");

/// The platter at the time of one frame.
struct PlatterState {
  double time_s = 0.0;     ///< since the first frame
  double angle_rad = 0.0;  ///< since the first frame; counter-clockwise seen from above
  double travel = 0.0;     ///< elapsed share of the recording: 0 at the first frame, 1 at the last
};

/// The states of all frames. With T the time of all frames together, the speed is
///   omega * r(t) * (1 + ripple * cos(ripple_cycles * theta)),   theta(t) = omega * int_0^t r,
/// where r rises from 0 to 1 during start_ramp after start_delay, and falls to 0 during stop_ramp
/// before T. Without a speed, omega is such that theta(T) equals the turns: without ramps frame i
/// of n is at turns * 2 pi * i / n. While the platter halts, t stands still, too; from slip_at on,
/// slip is added to the angle.
/// Fails with kInvalidOption if an option is out of range, if delay, ramps and halt take longer
/// than the recording, if halt or slip are outside it, or if the turns at the speed take more than
/// a million frames.
Result<std::vector<PlatterState>> platter_states(const MotionOptions& options);

/// The state at any time, also between the frames; before the first one and after the last the
/// platter's motion is continued. Precondition: platter_states succeeds.
PlatterState platter_state_at(const MotionOptions& options, double time_s);

/// Direction of the platter's axis at this angle: the rotation from its mean (+Y). It describes a
/// cone wobble_cycles times per turn. Once per turn corresponds to a platter mounted obliquely on a
/// true axis.
Eigen::Matrix3d axis_wobble(const MotionOptions& options, double angle_rad);

/// Offset of the platter's centre from its mean at this angle: on a circle that it describes
/// runout_cycles times per turn. Once per turn corresponds to a platter mounted off the centre of a
/// true axis.
Vec3d axis_runout(const MotionOptions& options, double angle_rad);

/// Checks that an event that happens is within the recording. Fails with kInvalidOption.
Result<> check_moment(const char* name, bool happens, double moment_s, double end_s);

/// Whether a frame of a scanner is lost: a pure function of its arguments.
bool frame_dropped(const MotionOptions& options, std::uint64_t seed, std::uint32_t frame,
                   std::uint32_t scanner);

}  // namespace turnscan
