#include <algorithm>
#include <numbers>
#include <turnscan/core/frame_excerpt.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/geometry/registration.hpp>
#include <turnscan/turntable/check.hpp>
#include <turnscan/turntable/motor_events.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

using namespace detail;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kPairs = 6;
constexpr double kBeside = 3.0 / kDegrees;  ///< of frames that show the same view, but for noise
constexpr double kAnglesWithin_deg = 1.5;
constexpr double kLeastLever = 0.02;  // share of a turn that the normals see; noise alone is less

/// What the recording says of a frame's angle; NaN: nothing.
std::vector<double> recorded_angles(const FrameSequence& sequence) {
  const auto& table = sequence.header().turntable;
  std::vector<double> out;
  for (const FrameInfo& frame : sequence.frames()) {
    double angle = frame.angle_rad.value_or(std::nan(""));
    if (!frame.angle_rad && table && table->speed_rad_s)
      angle = *table->speed_rad_s * (frame.time_s - sequence.frames().front().time_s);
    out.push_back(frame.status == FrameStatus::kOk && frame.sensor == 0 ? angle : std::nan(""));
  }
  return out;
}

struct TurnPair {
  std::size_t first, second;
  std::size_t beside = 0;  ///< frame next to the first that shows the same view; the first: none
};

std::size_t frame_beside(const FrameSequence& sequence, const std::vector<double>& angle,
                         std::size_t first) {
  for (std::size_t k = first + 1; k < angle.size(); ++k)
    if (std::abs(angle[k] - angle[first]) < kBeside &&
        sequence.frames()[k].pass == sequence.frames()[first].pass)
      return k;
  return first;
}

/// Frames one turn apart, spread over those that have a partner.
std::vector<TurnPair> turn_pairs(const FrameSequence& sequence, const std::vector<double>& angle) {
  std::vector<TurnPair> all;
  const auto& frames = sequence.frames();
  std::vector<double> steps;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    if (std::isfinite(angle[i] - angle[i - 1])) steps.push_back(std::abs(angle[i] - angle[i - 1]));
  }
  const double reach = std::max(1.5 / kDegrees, steps.empty() ? 0.0 : 0.6 * median(steps));
  for (std::size_t i = 0; i < angle.size(); ++i) {
    std::size_t best = i;
    double least = reach;
    for (std::size_t k = i + 1; k < angle.size(); ++k) {
      const double off = std::abs(std::abs(angle[k] - angle[i]) - kTurn);
      if (frames[k].pass == frames[i].pass && off < least) best = k, least = off;
    }
    if (best != i) all.push_back({i, best, frame_beside(sequence, angle, i)});
  }
  if (all.size() <= kPairs) return all;
  std::vector<TurnPair> out;
  for (std::size_t k = 0; k < kPairs; ++k) out.push_back(all[k * (all.size() - 1) / (kPairs - 1)]);
  return out;
}

struct PairClosure {
  double turn_rad, shift_m;
};

/// How far free registration moves the first frame's points from where the calibration puts them.
/// Only what it moves along the normals counts: a plate slides in its plane and a cylinder turns
/// about itself at no cost, and there registration finds anything.
std::optional<PairClosure> compare(const MotionFrame& first, const MotionFrame& second,
                                   const TurntableInfo& table, double turn,
                                   const RunContext& context) {
  if (first.samples.size() < 100 || second.samples.size() < 100) return std::nullopt;
  std::vector<Vec3f> points, targets, normals;
  const Vec3d axis = table.axis.normalized();
  const Eigen::AngleAxisd R(turn, axis);
  for (const MotionSample& s : first.samples)
    points.push_back((table.center_m + R * (s.p.cast<double>() - table.center_m)).cast<float>());
  for (const MotionSample& s : second.samples) {
    targets.push_back(s.p);
    normals.push_back(s.n);
  }
  IcpOptions options;
  options.max_distance_m = 0.02;
  options.tolerance_m = 2e-5;
  options.max_iterations = 200;
  const auto found = icp(points, targets, normals, Pose::Identity(), options, context);
  if (!found) return std::nullopt;
  double moved = 0.0, moved_by_turn = 0.0, lever = 0.0, reach = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d p = points[i].cast<double>();
    const Vec3d n = R * first.samples[i].n.cast<double>();
    const double along = n.dot(found->T_target_source * p - p);
    const Vec3d tangent = axis.cross(p - table.center_m);
    const double per_radian = n.dot(tangent);
    moved += along * along;
    moved_by_turn += along * per_radian;
    lever += per_radian * per_radian;
    reach += tangent.squaredNorm();
  }
  // Of a displacement, its normals see a third of the square where they point in all directions.
  const double shift = std::sqrt(3.0 * moved / double(points.size()));
  const bool shown = lever > kLeastLever * reach;
  return PairClosure{shown ? moved_by_turn / lever : std::nan(""), shift};
}

class Checker {
 public:
  Checker(const FrameSequence& sequence, const CheckOptions& options, const RunContext& context)
      : sequence_(sequence), options_(options), context_(context) {}

  Result<std::vector<Finding>> run() {
    TURNSCAN_TRY(look_at_closure());
    TURNSCAN_TRY(look_at_drift());
    auto found = calibrate_from_motion(sequence_, options_.motion, options_.detect, context_);
    if (!found) {
      if (found.error().code == ErrorCode::kCancelled) return tl::unexpected<Error>(found.error());
      say(false, "Motion: {}.", found.error().message);
      return std::move(findings_);
    }
    look_at_place(*found);
    look_at_direction(*found);
    look_at_speed(*found);
    look_at_angles(*found);
    TURNSCAN_TRY(look_at_motor(*found));
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void say(bool good, fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back({good, fmt::format(format, std::forward<Args>(args)...)});
  }

  Result<> look_at_closure() {
    auto closure = measure_closure(sequence_, context_);
    if (!closure) {
      if (closure.error().code != ErrorCode::kMissingData)
        return tl::unexpected<Error>(closure.error());
      say(false, "Closure: {}.", closure.error().message);
      return {};
    }
    if (!*closure) {
      say(true,
          "Closure: the recording does not come back to a view that it had before, so that "
          "nothing can be said.");
      return {};
    }
    const ClosureError& e = **closure;
    const std::string turn = std::isfinite(e.turn_rad)
                                 ? fmt::format(" and {:+.2f} deg", e.turn_rad * kDegrees)
                                 : std::string();
    say(!e.bad(),
        "Closure: one turn later the object lies {:.2f} mm{} from where it was ({} pairs "
        "of frames; noise alone shows {:.2f} mm).{}",
        e.shift_m * 1e3, turn, e.pairs, e.noise_m * 1e3,
        e.bad() ? " Axis, centre or speed of the recording are wrong." : "");
    return {};
  }

  /// Still pixels: mean depth of the first tenth of the frames and of the last.
  Result<> look_at_drift() {
    if (sequence_.header().sensors.front().kind != SensorKind::kDepthCamera) return {};
    const auto all = spread_positions(sequence_, 0, sequence_.frames().size());
    const std::size_t n = std::clamp<std::size_t>(all.size() / 10, 1, 20);
    if (all.size() < 8) return {};
    TURNSCAN_ASSIGN(
        const AveragedScan first,
        average_frames(sequence_, {all.begin(), all.begin() + std::ptrdiff_t(n)}, {}, context_));
    TURNSCAN_ASSIGN(
        const AveragedScan last,
        average_frames(sequence_, {all.end() - std::ptrdiff_t(n), all.end()}, {}, context_));
    TURNSCAN_ASSIGN(const AveragedScan whole,
                    average_frames(sequence_, spread_positions(sequence_, 0, 30), {}, context_));
    const ScanPixels pixels = pixels_of(whole);
    std::vector<double> moved;
    for (std::size_t i = 0; i < pixels.still.size(); ++i) {
      const float a = first.depth_m.pixels[i], b = last.depth_m.pixels[i];
      if (pixels.still[i] && a > 0.0f && b > 0.0f && std::abs(b - a) < 0.03f)
        moved.push_back(double(b) - double(a));
    }
    if (moved.size() < 500) return {};
    const double drift = median(moved);
    const bool good = std::abs(drift) < 0.001;
    say(good, "Warm-up: what stands still moved by {:+.2f} mm from the first frames to the last.{}",
        drift * 1e3, good ? "" : " The sensor was still warming up; let it run for half an hour.");
    return {};
  }

  void look_at_place(const Calibration& found) {
    const auto& table = sequence_.header().turntable;
    if (!table) {
      say(false, "Place: the recording does not say where the turntable is; its motion does.");
      return;
    }
    const Vec3d a = table->axis.normalized(), b = found.table.axis;
    const double tilt = std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
    const Vec3d off = table->center_m - found.table.center_m;
    const double aside = (off - off.dot(b) * b).norm() * 1e3;
    const bool good = tilt < 0.5 && aside < 1.5;
    say(good,
        "Place: the recorded axis leans by {:.2f} deg and lies {:.2f} mm beside the one that "
        "the motion shows.",
        tilt, aside);
  }

  bool told(const Calibration& found, const char* what) const {
    const auto& list = found.undetermined;
    return std::find(list.begin(), list.end(), what) == list.end();
  }

  void look_at_direction(const Calibration& found) {
    if (!told(found, "angles")) {
      say(true,
          "Direction: the object looks the same from all sides, so that nothing can be said.");
      return;
    }
    const auto angle = recorded_angles(sequence_);
    const double recorded = angle.back(), seen = found.angles_rad.back();
    if (!std::isfinite(recorded) || std::abs(seen) < 0.05) return;
    const bool good = recorded * seen > 0.0;
    say(good, "Direction: seen from above the platter turns {}clockwise{}.",
        seen > 0.0 ? "counter-" : "",
        good ? ", as recorded" : ", but the recording says the opposite: everything is mirrored");
  }

  void look_at_speed(const Calibration& found) {
    std::optional<double> stated = options_.motion.speed_rad_s;
    const auto& table = sequence_.header().turntable;
    if (!stated && table) stated = table->speed_rad_s;
    if (!stated || !found.table.speed_rad_s || !told(found, "speed")) return;
    const double ratio = *found.table.speed_rad_s / *stated;
    const bool good = std::abs(ratio - 1.0) < 0.005;
    say(good, "Speed: stated are {:.4f} deg/s, the data show {:.4f} deg/s{}.", *stated * kDegrees,
        *found.table.speed_rad_s * kDegrees,
        good ? "" : fmt::format(", {:+.2f} % off", 100.0 * (ratio - 1.0)));
  }

  /// Angles that every frame was recorded with, e.g. by an encoder, against those of the motion.
  void look_at_angles(const Calibration& found) {
    const auto& frames = sequence_.frames();
    has_angles_ = std::all_of(frames.begin(), frames.end(),
                              [](const FrameInfo& f) { return f.angle_rad.has_value(); });
    if (!has_angles_ || !told(found, "angles")) return;
    std::vector<double> off;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double recorded = *frames[i].angle_rad - *frames[0].angle_rad;
      const double sign = recorded * found.angles_rad[i] < 0.0 ? -1.0 : 1.0;
      off.push_back(std::abs(sign * recorded - found.angles_rad[i]) * kDegrees);
    }
    // A plate that is seen edge on shows little of its turn: some frames may be far off.
    std::sort(off.begin(), off.end());
    const double most = off[off.size() * 9 / 10];
    angles_good_ = most < kAnglesWithin_deg;
    say(angles_good_,
        "Angles: of nine in ten frames the recorded ones lie within {:.2f} deg of those that the "
        "motion shows.",
        most);
  }

  /// Of the time that the recording takes, not of the motor: nullopt without times.
  std::optional<double> usual_speed(const Calibration& found) const {
    if (found.table.speed_rad_s) return found.table.speed_rad_s;
    std::vector<double> speeds;
    const auto& frames = sequence_.frames();
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const double dt = frames[i].time_s - frames[i - 1].time_s;
      if (dt > 0.0) speeds.push_back((found.angles_rad[i] - found.angles_rad[i - 1]) / dt);
    }
    if (speeds.empty()) return std::nullopt;
    return median(speeds);
  }

  /// Slips and stops. Recorded angles may have followed them.
  Result<> look_at_motor(const Calibration& found) {
    if (!told(found, "angles")) {
      say(true, "Motor: the object looks the same from all sides, so that nothing can be said.");
      return {};
    }
    const auto speed = usual_speed(found);
    if (!speed || !(std::abs(*speed) > 0.0)) return {};
    MotionDataOptions loading;
    loading.detect = options_.detect;
    loading.most_keys = std::size_t(options_.motion.key_frames);
    loading.hint = found.table;
    TURNSCAN_ASSIGN(const MotionData data, load_motion(sequence_, loading, context_));
    MotionState state;
    state.axis = found.table.axis;
    state.center = found.table.center_m;
    const double first = sequence_.frames().front().time_s;
    // A table that starts slowly has no event there.
    const double start = found.start_s.value_or(first);
    const double steady = start > first + 0.1 ? start + 2.0 : first;
    const auto watch = [&](const std::vector<double>& expected, double from) {
      return watch_motor(data, state, expected, *speed, from, sequence_.frames().back().time_s,
                         context_);
    };
    TURNSCAN_ASSIGN(const MotorWatch evenly, watch({}, steady));
    if (!has_angles_) {
      say_events(evenly, "frames from there on have other angles than a constant speed gives");
      return {};
    }
    const auto expected = expected_angles(data, found);
    TURNSCAN_ASSIGN(const MotorWatch recorded, watch(expected, first));
    if (recorded.events.empty() && turns_evenly(data)) say_followed(evenly);
    say_events(recorded, "the recorded angles do not follow it");
    return {};
  }

  /// As recorded, in the direction in which the object is seen to turn.
  std::vector<double> expected_angles(const MotionData& data, const Calibration& found) const {
    const auto& frames = sequence_.frames();
    const double recorded = *frames.back().angle_rad - *frames.front().angle_rad;
    const double sign = recorded * found.angles_rad.back() < 0.0 ? -1.0 : 1.0;
    std::vector<double> out;
    for (const MotionFrame& frame : data.frames) out.push_back(sign * *frame.nominal_rad);
    return out;
  }

  /// Whether the recorded angles are those of a table that turns on while frames are taken: then
  /// most steps are alike, and a stop among them is one.
  static bool turns_evenly(const MotionData& data) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < data.frames.size(); ++i)
      speeds.push_back((*data.frames[i].nominal_rad - *data.frames[i - 1].nominal_rad) /
                       (data.frames[i].time_s - data.frames[i - 1].time_s));
    const double usual = median(speeds);
    const auto alike = std::count_if(speeds.begin(), speeds.end(), [&](double v) {
      return std::abs(v - usual) < 0.2 * std::abs(usual);
    });
    return 2 * std::size_t(alike) > speeds.size();
  }

  static std::string text_of(const MotorEvent& event, double speed_rad_s) {
    const double size = event.size_rad * (speed_rad_s < 0.0 ? -1.0 : 1.0) * kDegrees;
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

  void say_followed(const MotorWatch& watch) {
    for (const MotorEvent& event : watch.events)
      if (!is_rest(event))
        say(true, "Motor: {}; the recorded angles follow it.", text_of(event, watch.speed_rad_s));
  }

  void say_events(const MotorWatch& watch, const char* consequence) {
    bool any = false;
    for (const MotorEvent& event : watch.events) {
      if (!has_angles_ && is_rest(event)) continue;
      say(false, "Motor: {}; {}.", text_of(event, watch.speed_rad_s), consequence);
      any = true;
    }
    if (any) return;
    if (watch.told > 0.5) {
      say(true, "Motor: {}.",
          has_angles_ ? "no slip and no stop that the recorded angles do not have"
                      : "the table kept turning without a slip or a stop");
    } else {
      say(true,
          "Motor: the object shows its turn in {:.0f} % of the recording only; no slip and no stop "
          "was seen there.",
          100.0 * watch.told);
    }
  }

  const FrameSequence& sequence_;
  const CheckOptions& options_;
  const RunContext& context_;
  std::vector<Finding> findings_;
  bool has_angles_ = false, angles_good_ = true;
};

}  // namespace

bool ClosureError::bad() const {
  const double squared = shift_m * shift_m - noise_m * noise_m;
  return squared > 0.0015 * 0.0015 ||
         (std::isfinite(turn_rad) && std::abs(turn_rad) * kDegrees > 1.0);
}

Result<std::optional<ClosureError>> measure_closure(const FrameSequence& sequence,
                                                    const RunContext& context) {
  const auto& table = sequence.header().turntable;
  if (!table)
    return fail(ErrorCode::kMissingData, "the recording does not say where the turntable is");
  const auto angle = recorded_angles(sequence);
  if (std::none_of(angle.begin(), angle.end(), [](double a) { return std::isfinite(a); }))
    return fail(ErrorCode::kMissingData, "the recording has neither angles nor a speed");
  const auto pairs = turn_pairs(sequence, angle);
  if (pairs.empty()) return std::nullopt;
  std::vector<std::size_t> positions;
  for (const TurnPair& pair : pairs) {
    positions.push_back(pair.first);
    positions.push_back(pair.second);
    positions.push_back(pair.beside);
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  if (positions.size() < 3) return std::nullopt;
  MotionDataOptions loading;
  loading.hint = table;
  const FrameExcerpt excerpt(sequence, positions);
  const auto data = load_motion(excerpt, loading, context);
  if (!data) {
    if (data.error().code == ErrorCode::kTooFewPoints) return std::nullopt;
    return tl::unexpected<Error>(data.error());
  }
  std::vector<double> turns, shifts, noises;
  const auto frame_at = [&](std::size_t position) -> const MotionFrame& {
    const auto at = std::lower_bound(positions.begin(), positions.end(), position);
    return data->frames[std::size_t(at - positions.begin())];
  };
  for (const TurnPair& pair : pairs) {
    TURNSCAN_TRY(context.check());
    const auto between = [&](std::size_t other) {
      return compare(frame_at(pair.first), frame_at(other), *table,
                     angle[other] - angle[pair.first], context);
    };
    const auto closure = between(pair.second);
    if (!closure) continue;
    const auto noise = pair.beside != pair.first ? between(pair.beside) : std::nullopt;
    noises.push_back(noise ? noise->shift_m : 0.0);
    if (std::isfinite(closure->turn_rad)) turns.push_back(closure->turn_rad);
    shifts.push_back(closure->shift_m);
  }
  if (shifts.size() < 2) return std::nullopt;
  return ClosureError{median(turns, std::nan("")), median(shifts), median(noises), shifts.size()};
}

Result<std::vector<Finding>> check_recording(const FrameSequence& sequence,
                                             const CheckOptions& options,
                                             const RunContext& context) {
  return Checker(sequence, options, context).run();
}

}  // namespace turnscan
