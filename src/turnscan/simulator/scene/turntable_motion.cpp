#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/scene/turntable_motion.hpp>

namespace turnscan {

namespace {

constexpr int kDefaultFrames = 920;
constexpr double kMaxFrames = 1e6;
constexpr double kNever = 1e300;
constexpr std::uint64_t kDropSalt = 0x64726f70ULL;

/// Speed over time relative to the full one: 0, rising, 1, falling to 0 at the end. Its time
/// excludes the halt.
struct SpeedProfile {
  double delay_s, up_s, down_s, end_s, halt_at_s, halt_s;

  /// Integral from 0 to t of a ramp that starts at `begin` and reaches 1 after `length`.
  static double ramp_area(double t, double begin, double length) {
    const double inside = std::clamp(t - begin, 0.0, length);
    const double rising = length > 0.0 ? 0.5 * inside * inside / length : 0.0;
    return rising + std::max(0.0, t - begin - length);
  }

  /// Rotation until the time t at a full speed of 1.
  double turned(double t) const {
    if (t > halt_at_s) t = std::max(halt_at_s, t - halt_s);
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
                        o.halt_s + 0.5 * (o.start_ramp_s + o.stop_ramp_s);
  const double frames = std::round(time_s * o.fps);
  if (frames > kMaxFrames)
    return fail(ErrorCode::kInvalidOption,
                "{} turns at {} take {:.0f} frames, more than {:.0f}; give a number of frames",
                o.turns, format_quantity(*o.speed_rad_s, Quantity::kAngularSpeed), frames,
                kMaxFrames);
  return std::max(1, static_cast<int>(frames));
}

Result<double> full_speed(const MotionOptions& o, const SpeedProfile& profile) {
  if (profile.delay_s + profile.up_s + profile.down_s > profile.end_s * (1.0 + 1e-12))
    return fail(ErrorCode::kInvalidOption,
                "start-delay, start-ramp, halt and stop-ramp take {} together, but the recording "
                "only {}",
                format_quantity(profile.delay_s + profile.up_s + profile.halt_s + profile.down_s,
                                Quantity::kTime),
                format_quantity(profile.end_s + profile.halt_s, Quantity::kTime));
  TURNSCAN_TRY(check_moment("halt-at", o.halt_s != 0.0, o.halt_at_s, profile.end_s));
  TURNSCAN_TRY(
      check_moment("slip-at", o.slip_rad != 0.0, o.slip_at_s, profile.end_s + profile.halt_s));
  if (o.speed_rad_s) return *o.speed_rad_s;
  const double turned = profile.turned(profile.end_s + profile.halt_s);
  if (!(turned > 0.0))
    return fail(ErrorCode::kInvalidOption, "start-delay = {} leaves no time to turn",
                format_quantity(profile.delay_s, Quantity::kTime));
  return o.turns * kTurn / turned;
}

/// The platter's angle as a function of time.
struct Course {
  int count;  ///< of frames
  SpeedProfile profile;
  double speed;

  double angle_rad(const MotionOptions& o, double time_s) const {
    // Without delay and ramp it has turned before the first frame, too.
    const bool runs = o.start_delay_s == 0.0 && o.start_ramp_s == 0.0;
    const double turned = time_s < 0.0 && runs ? time_s : profile.turned(time_s);
    const double theta = speed * turned;
    // The integral of the ripple over theta.
    const double angle = theta + o.ripple / o.ripple_cycles * std::sin(o.ripple_cycles * theta);
    return o.slip_rad != 0.0 && time_s >= o.slip_at_s ? angle + o.slip_rad : angle;
  }
};

Result<Course> course_of(const MotionOptions& o) {
  TURNSCAN_ASSIGN(const int count, frame_count(o));
  const SpeedProfile profile{o.start_delay_s,
                             o.start_ramp_s,
                             o.stop_ramp_s,
                             count / o.fps - o.halt_s,
                             o.halt_s > 0.0 ? o.halt_at_s : kNever,
                             o.halt_s};
  TURNSCAN_ASSIGN(const double speed, full_speed(o, profile));
  return Course{count, profile, speed};
}

}  // namespace

OptionTable describe(MotionOptions& o, const std::string& speed_name) {
  OptionTable table;
  table
      .number("frames", o.frames, {1, kMaxFrames},
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
      .number("halt-at", o.halt_at_s, Quantity::kTime, {0.0, 1e5},
              "When the platter stops at once, if halt is given.")
      .number("halt", o.halt_s, Quantity::kTime, {0.0, 1e5},
              "How long it stands then before it goes on.")
      .number("slip-at", o.slip_at_s, Quantity::kTime, {0.0, 1e5},
              "When the platter jumps, if slip is given.")
      .number("slip", o.slip_rad, Quantity::kAngle, {-kTurn, kTurn},
              "By how much more it has turned from then on.")
      .number("ripple", o.ripple, Quantity::kNone, {0.0, 0.9},
              "Share of the speed by which it rises and falls: 0.01 for 1 %.")
      .number("ripple-cycles", o.ripple_cycles, Quantity::kNone, {0.01, 1000.0},
              "How often the speed rises and falls in one turn.")
      .number("wobble", o.wobble_rad, Quantity::kAngle, {0.0, 0.2},
              "By how much the axis leans to the side while it turns.")
      .number("wobble-cycles", o.wobble_cycles, Quantity::kNone, {0.0, 1000.0},
              "How often it goes round its mean in one turn; 1: the platter lies obliquely on a "
              "true axis.")
      .number("runout", o.runout_m, Quantity::kLength, {0.0, 0.1},
              "By how much the platter's centre is off the axis while it turns.")
      .number("runout-cycles", o.runout_cycles, Quantity::kNone, {0.0, 1000.0},
              "How often the centre goes round the axis in one turn; 1: the platter lies off the "
              "centre of a true axis.")
      .number("dropped", o.dropped, Quantity::kNone, {0.0, 1.0},
              "Share of the frames that are lost.");
  return table;
}

Result<std::vector<PlatterState>> platter_states(const MotionOptions& options) {
  MotionOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  TURNSCAN_ASSIGN(const Course course, course_of(options));
  std::vector<PlatterState> states(static_cast<std::size_t>(course.count));
  for (int i = 0; i < course.count; ++i) {
    PlatterState& state = states[static_cast<std::size_t>(i)];
    state.time_s = i / options.fps;
    state.angle_rad = course.angle_rad(options, state.time_s);
    state.travel = course.count > 1 ? double(i) / (course.count - 1) : 0.5;
  }
  return states;
}

PlatterState platter_state_at(const MotionOptions& options, double time_s) {
  const Course course = course_of(options).value();
  PlatterState state;
  state.time_s = time_s;
  state.angle_rad = course.angle_rad(options, time_s);
  state.travel = course.count > 1 ? time_s * options.fps / (course.count - 1) : 0.5;
  return state;
}

Eigen::Matrix3d axis_wobble(const MotionOptions& options, double angle_rad) {
  if (options.wobble_rad == 0.0) return Eigen::Matrix3d::Identity();
  const double way = options.wobble_cycles * angle_rad;
  const Vec3d about(std::cos(way), 0.0, -std::sin(way));
  return Eigen::AngleAxisd(options.wobble_rad, about).toRotationMatrix();
}

Vec3d axis_runout(const MotionOptions& options, double angle_rad) {
  const double way = options.runout_cycles * angle_rad;
  return options.runout_m * Vec3d(std::cos(way), 0.0, -std::sin(way));
}

Result<> check_moment(const char* name, bool happens, double moment_s, double end_s) {
  if (!happens || moment_s < end_s) return {};
  return fail(ErrorCode::kInvalidOption, "{} = {} is not within the recording, which takes {}",
              name, format_quantity(moment_s, Quantity::kTime),
              format_quantity(end_s, Quantity::kTime));
}

bool frame_dropped(const MotionOptions& options, std::uint64_t seed, std::uint32_t frame,
                   std::uint32_t scanner) {
  return options.dropped > 0.0 &&
         uniform01(hash_key(seed ^ kDropSalt, scanner, frame)) < options.dropped;
}

}  // namespace turnscan
