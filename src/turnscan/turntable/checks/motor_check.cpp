#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/checks/motor_check.hpp>
#include <turnscan/turntable/checks/motor_events.hpp>

namespace turnscan::checks {

namespace {

using motion::MotionData;
using motion::MotionFrame;
using motion::MotionState;

class MotorCheck {
 public:
  MotorCheck(const FrameSequence& sequence, const CheckOptions& options, const Calibration& found,
             const RunContext& context)
      : sequence_(sequence), options_(options), found_(found), context_(context) {
    const auto& frames = sequence.frames();
    has_angles_ = std::all_of(frames.begin(), frames.end(),
                              [](const FrameInfo& f) { return f.angle_rad.has_value(); });
  }

  Result<std::vector<Finding>> run() {
    const auto speed = usual_speed();
    if (!speed || !(std::abs(*speed) > 0.0)) return std::move(findings_);
    TURNSCAN_ASSIGN(const MotionData data, load_frames());
    MotionState state;
    state.axis = found_.table.axis;
    state.center = found_.table.center_m;
    const double first = sequence_.frames().front().time_s;
    // A slow start of the table is not an event.
    const double start = found_.start_s.value_or(first);
    const double steady = start > first + 0.1 ? start + 2.0 : first;
    const auto events_from = [&](double from, const std::vector<double>& expected) {
      return find_motor_events(data, state, expected, *speed, from,
                               sequence_.frames().back().time_s, context_);
    };
    TURNSCAN_ASSIGN(const MotorObservation evenly, events_from(steady, {}));
    if (!has_angles_) {
      add_events(evenly, "frames from there on have other angles than a constant speed gives");
      return std::move(findings_);
    }
    const auto expected = expected_angles(data);
    TURNSCAN_ASSIGN(const MotorObservation recorded, events_from(first, expected));
    if (recorded.events.empty() && turns_evenly(data)) add_followed(evenly);
    add_events(recorded, "the recorded angles do not follow it");
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void say(Rating rating, fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back({rating, fmt::format(format, std::forward<Args>(args)...)});
  }

  Result<MotionData> load_frames() const {
    motion::MotionDataOptions loading;
    loading.detect = options_.detect;
    loading.max_keys = std::size_t(options_.motion.key_frames);
    loading.hint = found_.table;
    return load_motion(sequence_, loading, context_);
  }

  /// Speed from the duration of the recording, not from the motor: nullopt without times.
  std::optional<double> usual_speed() const {
    if (found_.table.speed_rad_s) return found_.table.speed_rad_s;
    std::vector<double> speeds;
    const auto& frames = sequence_.frames();
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const double dt = frames[i].time_s - frames[i - 1].time_s;
      if (dt > 0.0) speeds.push_back((found_.angles_rad[i] - found_.angles_rad[i - 1]) / dt);
    }
    if (speeds.empty()) return std::nullopt;
    return median(speeds);
  }

  /// The recorded angles, in the direction in which the object is observed to turn.
  std::vector<double> expected_angles(const MotionData& data) const {
    const auto& frames = sequence_.frames();
    const double recorded = *frames.back().angle_rad - *frames.front().angle_rad;
    const double sign = recorded * found_.angles_rad.back() < 0.0 ? -1.0 : 1.0;
    std::vector<double> out;
    for (const MotionFrame& frame : data.frames) out.push_back(sign * *frame.nominal_rad);
    return out;
  }

  /// Whether the recorded angles are those of a table that turns while frames are taken: then most
  /// steps have about the same speed, and a stop among them is an event.
  static bool turns_evenly(const MotionData& data) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < data.frames.size(); ++i)
      speeds.push_back((*data.frames[i].nominal_rad - *data.frames[i - 1].nominal_rad) /
                       (data.frames[i].time_s - data.frames[i - 1].time_s));
    const double usual = median(speeds);
    const auto usual_steps = std::count_if(speeds.begin(), speeds.end(), [&](double v) {
      return std::abs(v - usual) < 0.2 * std::abs(usual);
    });
    return 2 * std::size_t(usual_steps) > speeds.size();
  }

  static std::string text_of(const MotorEvent& event, double speed_rad_s) {
    const double size = event.size_rad * (speed_rad_s < 0.0 ? -1.0 : 1.0) * kDegreesPerRadian;
    if (event.lasts_s > 0.0)
      return fmt::format("about {:.1f} s the table slowed down or stopped, for about {:.1f} s",
                         event.time_s, event.lasts_s);
    return fmt::format("about {:.1f} s the table slipped {} by about {:.0f} deg", event.time_s,
                       size > 0.0 ? "ahead" : "back", std::abs(size));
  }

  /// At the end of a recording a table may come to rest.
  bool is_rest(const MotorEvent& event) const {
    return event.lasts_s > 0.0 &&
           event.time_s + event.lasts_s > sequence_.frames().back().time_s - 1.5;
  }

  void add_followed(const MotorObservation& seen) {
    for (const MotorEvent& event : seen.events)
      if (!is_rest(event))
        say(Rating::kGood, "Motor: {}; the recorded angles follow it.",
            text_of(event, seen.speed_rad_s));
  }

  void add_events(const MotorObservation& seen, const char* consequence) {
    bool any = false;
    for (const MotorEvent& event : seen.events) {
      if (!has_angles_ && is_rest(event)) continue;
      say(Rating::kWrong, "Motor: {}; {}.", text_of(event, seen.speed_rad_s), consequence);
      any = true;
    }
    if (any) return;
    if (seen.observed_share > 0.5) {
      say(Rating::kGood, "Motor: {}.",
          has_angles_ ? "no slip and no stop that the recorded angles do not have"
                      : "the table kept turning without a slip or a stop");
    } else {
      say(Rating::kNotKnown,
          "Motor: the object shows its turn in {:.0f} % of the recording only; no slip and no stop "
          "was seen there.",
          100.0 * seen.observed_share);
    }
  }

  const FrameSequence& sequence_;
  const CheckOptions& options_;
  const Calibration& found_;
  const RunContext& context_;
  std::vector<Finding> findings_;
  bool has_angles_ = false;
};

}  // namespace

Result<std::vector<Finding>> check_motor(const FrameSequence& sequence, const CheckOptions& options,
                                         const Calibration& found, const RunContext& context) {
  return MotorCheck(sequence, options, found, context).run();
}

}  // namespace turnscan::checks
