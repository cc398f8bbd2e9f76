#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/turntable_motion.hpp>

namespace turnscan {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kDefaultFrames = 920;
constexpr double kMostFrames = 1e6;
constexpr std::uint64_t kDropSalt = 0x64726f70ULL;

/// Speed over time as a share of the full one: 0, up, 1, down to 0 at the end.
struct SpeedProfile {
  double delay_s, up_s, down_s, end_s;

  /// Integral from 0 to t of a ramp that starts at `begin` and reaches 1 after `length`.
  static double ramp_area(double t, double begin, double length) {
    const double inside = std::clamp(t - begin, 0.0, length);
    const double rising = length > 0.0 ? 0.5 * inside * inside / length : 0.0;
    return rising + std::max(0.0, t - begin - length);
  }

  /// Turned by the time t at a full speed of 1.
  double turned(double t) const {
    return ramp_area(t, delay_s, up_s) - ramp_area(t, end_s - down_s, down_s);
  }
};

Result<int> frame_count(const MotionOptions& o) {
  if (o.frames) return *o.frames;
  if (!o.speed_rad_s) return kDefaultFrames;
  if (*o.speed_rad_s == 0.0)
    return fail(ErrorCode::kInvalidOption,
                "speed = 0 makes no turn; give the number of frames with it");
  const double time_s = std::abs(o.turns) * kTurn / std::abs(*o.speed_rad_s) + o.start_delay_s +
                        0.5 * (o.start_ramp_s + o.stop_ramp_s);
  const double frames = std::round(time_s * o.fps);
  if (frames > kMostFrames)
    return fail(ErrorCode::kInvalidOption,
                "{} turns at {} take {:.0f} frames, more than {:.0f}; give a number of frames",
                o.turns, format_quantity(*o.speed_rad_s, Quantity::kAngularSpeed), frames,
                kMostFrames);
  return std::max(1, static_cast<int>(frames));
}

Result<double> full_speed(const MotionOptions& o, const SpeedProfile& profile) {
  if (profile.delay_s + profile.up_s + profile.down_s > profile.end_s * (1.0 + 1e-12))
    return fail(ErrorCode::kInvalidOption,
                "start-delay, start-ramp and stop-ramp take {} together, but the recording only {}",
                format_quantity(profile.delay_s + profile.up_s + profile.down_s, Quantity::kTime),
                format_quantity(profile.end_s, Quantity::kTime));
  if (o.speed_rad_s) return *o.speed_rad_s;
  const double turned = profile.turned(profile.end_s);
  if (!(turned > 0.0))
    return fail(ErrorCode::kInvalidOption, "start-delay = {} leaves no time to turn",
                format_quantity(profile.delay_s, Quantity::kTime));
  return o.turns * kTurn / turned;
}

}  // namespace

OptionTable describe(MotionOptions& o, const std::string& speed_name) {
  OptionTable table;
  table
      .number("frames", o.frames, {1, kMostFrames},
              "Number of frames of each scanner; auto: 920, or with a speed as many as the turns "
              "take.")
      .number("turns", o.turns, Quantity::kNone, {-1000.0, 1000.0},
              "Turns of the platter that the frames are spread over, unless frames and speed say "
              "otherwise; negative: clockwise seen from above.")
      .number("fps", o.fps, Quantity::kNone, {1e-3, 1e6}, "Frames a second.")
      .number(speed_name, o.speed_rad_s, Quantity::kAngularSpeed, {-1000.0, 1000.0},
              "Speed of the platter; auto: from turns, frames and fps.")
      .number("start-delay", o.start_delay_s, Quantity::kTime, {0.0, 1e5},
              "How long the platter stands still at the beginning.")
      .number("start-ramp", o.start_ramp_s, Quantity::kTime, {0.0, 1e5},
              "How long the platter takes to reach its speed.")
      .number("stop-ramp", o.stop_ramp_s, Quantity::kTime, {0.0, 1e5},
              "How long it takes to come to rest at the end.")
      .number("ripple", o.ripple, Quantity::kNone, {0.0, 0.9},
              "Share of the speed by which it rises and falls: 0.01 for 1 %.")
      .number("ripple-cycles", o.ripple_cycles, Quantity::kNone, {0.01, 1000.0},
              "How often the speed rises and falls in one turn.")
      .number("wobble", o.wobble_rad, Quantity::kAngle, {0.0, 0.2},
              "By how much the axis leans to the side while it turns.")
      .number("wobble-cycles", o.wobble_cycles, Quantity::kNone, {0.0, 1000.0},
              "How often it goes round its mean in one turn.")
      .number("dropped", o.dropped, Quantity::kNone, {0.0, 1.0},
              "Share of the frames that are lost.");
  return table;
}

Result<std::vector<PlatterState>> platter_states(const MotionOptions& options) {
  MotionOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  TURNSCAN_ASSIGN(const int count, frame_count(options));
  const SpeedProfile profile{options.start_delay_s, options.start_ramp_s, options.stop_ramp_s,
                             count / options.fps};
  TURNSCAN_ASSIGN(const double speed, full_speed(options, profile));
  std::vector<PlatterState> states(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    PlatterState& state = states[static_cast<std::size_t>(i)];
    state.time_s = i / options.fps;
    const double theta = speed * profile.turned(state.time_s);
    // The integral of the ripple over theta.
    state.angle_rad =
        theta + options.ripple / options.ripple_cycles * std::sin(options.ripple_cycles * theta);
    state.travel = count > 1 ? double(i) / (count - 1) : 0.5;
  }
  return states;
}

Eigen::Matrix3d axis_wobble(const MotionOptions& options, double angle_rad) {
  if (options.wobble_rad == 0.0) return Eigen::Matrix3d::Identity();
  const double way = options.wobble_cycles * angle_rad;
  const Vec3d about(std::cos(way), 0.0, -std::sin(way));
  return Eigen::AngleAxisd(options.wobble_rad, about).toRotationMatrix();
}

bool frame_dropped(const MotionOptions& options, std::uint64_t seed, std::uint32_t frame,
                   std::uint32_t scanner) {
  return options.dropped > 0.0 &&
         uniform01(hash_key(seed ^ kDropSalt, scanner, frame)) < options.dropped;
}

}  // namespace turnscan
