#include <algorithm>
#include <array>
#include <numbers>
#include <turnscan/turntable/motion.hpp>
#include <turnscan/turntable/motion_model.hpp>
#include <turnscan/turntable/motion_one.hpp>
#include <turnscan/turntable/motion_start.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

using namespace detail;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kStandsWithin = 0.2 * kDegree;
constexpr double kTellsLaws = 8.0;     ///< difference of MotionSolution::misfit
constexpr double kTellsTheTurn = 2.0;  ///< turn_information below which the angles are not seen

constexpr std::size_t kModelFrames = 24;

enum class AngleSource { kTimes, kAngles, kNothing };

class Calibrator {
 public:
  Calibrator(const FrameSequence& sequence, const FromMotionOptions& options,
             const DetectOptions& detect, const RunContext& context)
      : sequence_(sequence), options_(options), detect_(detect), context_(context) {}

  Result<Calibration> run() {
    MotionDataOptions loading;
    loading.detect = detect_;
    loading.most_keys = std::size_t(options_.key_frames);
    if (options_.use_table) loading.hint = sequence_.header().turntable;
    TURNSCAN_ASSIGN(data_, load_motion(sequence_, loading, context_));
    source_ = source_of_angles();
    context_.begin_phase("find the motion", 4);
    TURNSCAN_TRY(start(loading.hint));
    context_.advance();
    TURNSCAN_TRY(refine());
    return result();
  }

  /// After run(): some of what was seen, where it was at angle 0.
  Result<MotionResult> compared(Calibration calibration, std::size_t most) const {
    MotionResult out;
    TURNSCAN_ASSIGN(const Pose T_table_sensor, table_from_sensor(calibration.table));
    std::size_t all = 0;
    for (const MotionFrame& frame : data_.frames) all += frame.samples.size();
    const std::size_t stride = most == 0 ? all + 1 : std::max<std::size_t>(1, all / most);
    std::size_t next = stride / 2;
    for (std::size_t i = 0; i < data_.frames.size(); ++i) {
      const auto& samples = data_.frames[i].samples;
      const Pose T = rotation_about_y(-state_.angle[i]) * T_table_sensor;
      for (; next < samples.size(); next += stride) {
        MotionSample s = samples[next];
        s.p = (T * s.p.cast<double>()).cast<float>();
        s.n = (T.linear() * s.n.cast<double>()).cast<float>();
        out.model.push_back(s);
      }
      next -= samples.size();
    }
    out.noise_m = data_.noise_m;
    out.spacing_m = data_.spacing_m;
    out.platter = data_.platter.has_value();
    out.calibration = std::move(calibration);
    return out;
  }

 private:
  AngleSource source_of_angles() const {
    const auto has_angle = [](const MotionFrame& f) { return f.nominal_rad.has_value(); };
    const auto has_time = [](const MotionFrame& f) { return std::isfinite(f.time_s); };
    const auto& frames = data_.frames;
    if (options_.use_angles && std::all_of(frames.begin(), frames.end(), has_angle))
      return AngleSource::kAngles;
    if (std::all_of(frames.begin(), frames.end(), has_time)) return AngleSource::kTimes;
    return AngleSource::kNothing;
  }

  /// Of the axes to start from the one at which the frames fit best.
  Result<> start(const std::optional<TurntableInfo>& hint) {
    double least = 2.0;
    for (MotionState& state : start_axes(data_, hint)) {
      TURNSCAN_TRY(context_.check());
      TURNSCAN_ASSIGN(const double cost, start_angles(state));
      TURNSCAN_ASSIGN(const MotionSolution rough, solve_roughly(state));
      const double quality = cost_of(rough.state);
      (void)cost;
      if (quality < least) {
        least = quality;
        state_ = rough.state;
        chosen_ = law_;
      }
    }
    law_ = chosen_;
    return {};
  }

  Result<MotionSolution> solve_roughly(const MotionState& state) {
    SolveOptions options;
    options.iterations = 6;
    options.reach_m = 0.03;
    options.floor_m = 0.004;
    options.stride = stride_for(6);
    options.hold_angles = !tells_turn_;
    auto rough = solve_motion(data_, state, choose_pairs(data_, state.angle, false), law_, options,
                              context_);
    if (rough || rough.error().code == ErrorCode::kCancelled) return rough;
    MotionSolution none;
    none.state = state;
    return none;
  }

  /// Mean cost of neighbouring frames, as they fit with the axis and the angles.
  double cost_of(const MotionState& state) const {
    const auto pairs = choose_pairs(data_, state.angle, false);
    const double gate = std::max(3.0 * data_.noise_m, 0.004);
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < pairs.size(); k += 1 + pairs.size() / 400) {
      sum += pair_cost(data_, state, pairs[k],
                       state.angle[pairs[k].to] - state.angle[pairs[k].from], gate, 200);
      count += 1.0;
    }
    return count > 0.0 ? sum / count : 1.0;
  }

  Result<double> start_angles(MotionState& state) {
    law_ = {};
    tells_turn_ =
        source_ == AngleSource::kNothing || turn_information(data_, state) > kTellsTheTurn;
    switch (source_) {
      case AngleSource::kTimes:
        return start_from_times(state);
      case AngleSource::kAngles:
        return start_from_angles(state);
      case AngleSource::kNothing:
        return search_steps(data_, state);
    }
    return 1.0;
  }

  Result<double> start_from_times(MotionState& state) {
    const SpeedGuess guess = guess_speed(data_, state);
    const double t0 = data_.frames.front().time_s;
    double speed = guess.speed_rad_s;
    if (!tells_turn_) {
      std::optional<double> known = options_.speed_rad_s;
      if (!known && options_.use_table && sequence_.header().turntable)
        known = sequence_.header().turntable->speed_rad_s;
      if (!known)
        return fail(ErrorCode::kMissingData,
                    "motion: the object looks the same from all sides, so that its speed cannot be "
                    "seen; give --speed");
      speed = *known;
      law_.stated_rad_s = known;
    }
    law_.timed = true;
    law_.speed_rad_s = speed;
    for (std::size_t i = 0; i < state.angle.size(); ++i)
      state.angle[i] = speed * (data_.frames[i].time_s - t0);
    if (tells_turn_) follow(data_, state, 0.3);
    return guess.cost;
  }

  /// The list of angles may count the other way round.
  Result<double> start_from_angles(MotionState& state) {
    law_.nominal_sigma_rad = options_.angle_sigma_rad;
    std::array<double, 2> cost{};
    std::array<MotionState, 2> states{state, state};
    for (const int k : {0, 1}) {
      law_.nominal_sign = k == 0 ? 1.0 : -1.0;
      const double zero = *data_.frames[0].nominal_rad;
      for (std::size_t i = 0; i < state.angle.size(); ++i)
        states[std::size_t(k)].angle[i] = law_.nominal_sign * (*data_.frames[i].nominal_rad - zero);
      cost[std::size_t(k)] = cost_of(states[std::size_t(k)]);
    }
    const int best = cost[1] < 0.8 * cost[0] ? 1 : 0;
    law_.nominal_sign = best == 0 ? 1.0 : -1.0;
    state = states[std::size_t(best)];
    return cost[std::size_t(best)];
  }

  Result<> refine() {
    SolveOptions options;
    options.reach_m = 0.02;
    options.floor_m = 0.002;
    options.iterations = 8;
    options.stride = stride_for(4);
    TURNSCAN_TRY(solve(options, false));
    const bool told = tells_turn_;
    tells_turn_ =
        source_ == AngleSource::kNothing || turn_information(data_, state_) > kTellsTheTurn;
    if (told && !tells_turn_) {
      reset_to_law();
      TURNSCAN_TRY(solve(options, false));
    }
    if (find_starts()) {
      options.iterations = 4;
      options.reach_m = std::max(0.004, 12.0 * solution_.scale_m);
      TURNSCAN_TRY(solve(options, false));
      find_stills();
    }
    TURNSCAN_TRY(choose_wander(options));
    options.stride = 1;
    options.iterations = 5;
    options.reach_m = 0.01;
    options.floor_m = 0.0;
    TURNSCAN_TRY(solve(options, false));
    // At last with all frames; the pairs follow the angles.
    options.iterations = 3;
    options.covariance = true;
    TURNSCAN_TRY(solve(options, true));
    return refine_with_model();
  }

  /// Few views, far apart, have too little in common for a model; and where the angles are the
  /// law's, pairs of views do not drift.
  Result<> refine_with_model() {
    if (!data_.projective || !tells_turn_ || data_.keys.size() < kModelFrames) return {};
    TURNSCAN_ASSIGN(solution_, solve_model(data_, solution_, law_, {}, context_));
    state_ = solution_.state;
    return {};
  }

  /// Few frames have no samples to spare.
  std::size_t stride_for(std::size_t wanted) const { return data_.keys.size() > 24 ? wanted : 1; }

  Result<> solve(SolveOptions options, bool all_frames) {
    options.hold_angles = !tells_turn_;
    const auto pairs = choose_pairs(data_, state_.angle, all_frames);
    TURNSCAN_ASSIGN(solution_, solve_motion(data_, state_, pairs, law_, options, context_));
    state_ = solution_.state;
    context_.advance();
    return {};
  }

  /// Where the speed over about a second is far from the usual one, the table starts or stops.
  bool find_starts() {
    if (source_ != AngleSource::kTimes || !tells_turn_ || data_.keys.size() < 24) return false;
    const auto& keys = data_.keys;
    const auto time = [&](std::size_t k) { return data_.frames[keys[k]].time_s; };
    std::vector<double> speed(keys.size(), 0.0);
    const double half = std::max(0.4, 1.5 * (time(1) - time(0)));
    for (std::size_t k = 0, a = 0, b = 0; k < keys.size(); ++k) {
      while (time(k) - time(a) > half) ++a;
      while (b + 1 < keys.size() && time(b) - time(k) < half) ++b;
      speed[k] = (state_.angle[keys[b]] - state_.angle[keys[a]]) / (time(b) - time(a));
    }
    std::vector<double> sorted = speed;
    std::sort(sorted.begin(), sorted.end());
    const double usual = sorted[sorted.size() / 2];
    law_.speed_rad_s = usual;
    law_.loose.assign(data_.frames.size(), 0);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (std::abs(speed[k] / usual - 1.0) < 0.15) continue;
      for (std::size_t i = 0; i < data_.frames.size(); ++i) {
        if (std::abs(data_.frames[i].time_s - time(k)) < half) law_.loose[i] = 1;
      }
    }
    return std::count(law_.loose.begin(), law_.loose.end(), 1) > 0;
  }

  /// How long the table stands before it starts and after it stopped: until an angle is farther
  /// from the mean of those before than they can be by chance. What the table turns by meanwhile
  /// is less than can be seen.
  void find_stills() {
    const std::size_t n = state_.angle.size();
    law_.still.assign(n, 0);
    const auto walk = [&](auto index) {
      double sum = 0.0;
      std::size_t count = 0;
      for (; count < n / 2; ++count) {
        const double a = state_.angle[index(count)];
        if (law_.loose[index(count)] == 0) break;
        if (count > 0 && std::abs(a - sum / double(count)) > kStandsWithin) break;
        sum += a;
      }
      count -= count / 4;  // it moved already when that could be seen
      for (std::size_t i = 0; i < count && count > 2; ++i) law_.still[index(i)] = 1;
    };
    walk([](std::size_t i) { return i; });
    walk([n](std::size_t i) { return n - 1 - i; });
  }

  /// How evenly the table turns is told by the data, too: the law of largest evidence (MacKay 1992,
  /// "Bayesian interpolation").
  Result<> choose_wander(SolveOptions options) {
    if (source_ != AngleSource::kTimes || !tells_turn_ || data_.keys.size() < 12) return {};
    const auto pairs = choose_pairs(data_, state_.angle, false);
    options.scale_m = solution_.scale_m;
    options.unit_m2 = solution_.unit_m2;
    options.iterations = 4;
    options.reach_m = std::max(0.004, 12.0 * solution_.scale_m);
    std::optional<MotionSolution> best;
    double wander = law_.wander;
    for (const double share : {2e-4, 1e-3, 2.5e-3, 6e-3, 1.5e-2}) {
      law_.wander = share;
      TURNSCAN_ASSIGN(MotionSolution tried,
                      solve_motion(data_, state_, pairs, law_, options, context_));
      // The steadiest of those that are about as probable.
      if (best && best->misfit <= tried.misfit + kTellsLaws) continue;
      best = std::move(tried);
      wander = share;
    }
    law_.wander = wander;
    state_ = best->state;
    return {};
  }

  /// The shape says nothing about the turn: back to what times or angles say.
  void reset_to_law() {
    const double t0 = data_.frames.front().time_s;
    for (std::size_t i = 0; i < state_.angle.size(); ++i) {
      if (source_ == AngleSource::kTimes)
        state_.angle[i] =
            options_.speed_rad_s.value_or(law_.speed_rad_s) * (data_.frames[i].time_s - t0);
      if (source_ == AngleSource::kAngles)
        state_.angle[i] =
            law_.nominal_sign * (*data_.frames[i].nominal_rad - *data_.frames[0].nominal_rad);
    }
    if (options_.speed_rad_s) law_.stated_rad_s = options_.speed_rad_s;
  }

  Result<Calibration> result() {
    if (cost_of(state_) > 0.85 ||
        solution_.scale_m > std::max({0.003, 4.0 * data_.noise_m, 2.0 * data_.spacing_m}))
      return fail(ErrorCode::kLibrary,
                  "motion: no axis was found about which the frames fit; calibrate with --detect "
                  "or --points, or take more frames a turn");
    Calibration out;
    out.method = CalibrationMethod::kMotion;
    out.residual_rms_m = solution_.rms_m;
    out.notes = data_.notes;
    put_axis(out);
    put_height(out);
    put_angles(out);
    if (source_ == AngleSource::kTimes) put_speed(out);
    if (law_.nominal_sign < 0.0)
      out.notes.emplace_back(
          "the recorded angles count clockwise seen from above: the frames fit "
          "when their sign is changed");
    return out;
  }

  void put_axis(Calibration& out) const {
    Vec3d axis = state_.axis;
    out.table.axis = axis;
    // Besides noise: what smoothing and mixed pixels at silhouettes shift, a few hundredths of a
    // pixel, and over the size of what turns still a hundredth.
    const double shift = 0.03 * data_.spacing_m, tilt = 0.01 * data_.spacing_m / data_.extent_m;
    const auto& c = solution_.covariance;
    out.axis_sigma_rad = std::sqrt(c(0, 0) + c(1, 1) + tilt * tilt);
    out.center_sigma_m = std::sqrt(c(2, 2) + c(3, 3) + shift * shift);
    const std::string how = fmt::format("motion of {} frames, {} distances between them",
                                        data_.frames.size(), solution_.residuals);
    out.axis_found = out.center_found = how;
    if (out.axis_sigma_rad > 1.0 * kDegree) out.undetermined.emplace_back("axis");
    if (out.center_sigma_m > 0.003) out.undetermined.emplace_back("centre");
  }

  /// The axis meets the platter's surface, or else ends at the object's lowest points.
  void put_height(Calibration& out) const {
    const Vec3d a = state_.axis;
    if (data_.platter) {
      const DetectedPlatter& p = *data_.platter;
      const double along = p.axis.dot(p.center_m - state_.center) / p.axis.dot(a);
      out.table.center_m = state_.center + along * a;
      out.table.radius_m = p.radius_m;
      out.radius_sigma_m = p.radius_sigma_m;
      out.height_sigma_m = p.height_sigma_m;
      out.rim_share = p.rim_share;
      out.confidence = p.confidence;
      out.height_found = "the platter's surface";
      out.radius_found = "the platter's rim";
      return;
    }
    std::vector<double> heights;
    for (const Vec3f& p : data_.cloud) heights.push_back(a.dot(p.cast<double>() - state_.center));
    const auto low = heights.begin() + std::ptrdiff_t(heights.size() / 200);
    std::nth_element(heights.begin(), low, heights.end());
    out.table.center_m = state_.center + *low * a;
    out.height_sigma_m = std::max(0.002, 2.0 * data_.noise_m);
    out.height_found = "the lowest points of what turns";
    const auto& table = sequence_.header().turntable;
    if (table && options_.use_table && table->radius_m) {
      out.table.radius_m = table->radius_m;
      out.radius_found = "the recording's";
    }
  }

  /// Frames of other sensors and dropped ones get theirs by time, or from their neighbours.
  void put_angles(Calibration& out) const {
    const auto& infos = sequence_.frames();
    out.angles_rad.assign(infos.size(), 0.0);
    out.angle_sigma_rad.assign(infos.size(), std::nan(""));
    std::size_t next = 0;
    for (std::size_t i = 0; i < infos.size(); ++i) {
      while (next < data_.frames.size() && data_.frames[next].position < i) ++next;
      if (next < data_.frames.size() && data_.frames[next].position == i) {
        out.angles_rad[i] = state_.angle[next];
        out.angle_sigma_rad[i] = next == 0 ? 0.0 : angle_sigma(next);
        continue;
      }
      out.angles_rad[i] = between(next, infos[i].time_s);
    }
    out.angles_found = tells_turn_ ? "motion of each frame" : "the law of the motor alone";
    if (!tells_turn_) out.undetermined.emplace_back("angles");
  }

  /// As for the axis: what silhouettes shift, a few hundredths of a pixel.
  double angle_sigma(std::size_t i) const {
    return std::hypot(solution_.angle_sigma[i],
                      tells_turn_ ? 0.03 * data_.spacing_m / data_.extent_m : 0.0);
  }

  double between(std::size_t next, double time_s) const {
    const auto& frames = data_.frames;
    if (frames.size() < 2) return 0.0;
    const std::size_t b = std::clamp<std::size_t>(next, 1, frames.size() - 1), a = b - 1;
    const double span = frames[b].time_s - frames[a].time_s;
    const double share =
        std::isfinite(time_s) && span > 0.0 ? (time_s - frames[a].time_s) / span : 0.5;
    return state_.angle[a] + share * (state_.angle[b] - state_.angle[a]);
  }

  /// The steady speed: the slope of the angles over time once the table runs, and the moment at
  /// which that line left the angle that the table stood at.
  void put_speed(Calibration& out) const {
    const auto& frames = data_.frames;
    const std::size_t n = frames.size();
    const auto slope = [&](std::size_t a, std::size_t b) {
      return (state_.angle[b] - state_.angle[a]) / (frames[b].time_s - frames[a].time_s);
    };
    const double middle = slope(n / 4, 3 * n / 4);
    // Runs: from where a stretch of a twentieth goes at nearly the steady speed.
    const std::size_t stretch = std::max<std::size_t>(1, n / 20);
    std::size_t first = 0, last = n - 1;
    while (first + stretch < n / 4 && slope(first, first + stretch) / middle < 0.93) ++first;
    while (last > stretch + 3 * n / 4 && slope(last - stretch, last) / middle < 0.93) --last;
    double t = 0.0, y = 0.0, tt = 0.0, ty = 0.0, count = 0.0;
    for (std::size_t i = first; i <= last; ++i)
      t += frames[i].time_s, y += state_.angle[i], ++count;
    t /= count, y /= count;
    for (std::size_t i = first; i <= last; ++i) {
      tt += std::pow(frames[i].time_s - t, 2);
      ty += (frames[i].time_s - t) * (state_.angle[i] - y);
    }
    const double speed = ty / tt;
    out.table.speed_rad_s = speed;
    const double span = frames[last].time_s - frames[first].time_s;
    double sigma = 0.0;
    for (std::size_t i = first; i <= last; ++i) sigma = std::max(sigma, solution_.angle_sigma[i]);
    out.speed_sigma_rad_s = sigma / span;
    out.speed_found = tells_turn_ ? "slope of the angles over time" : "stated";
    if (!tells_turn_) {
      out.undetermined.emplace_back("speed");
      out.speed_sigma_rad_s = std::nan("");
    }
    const double start = t - y / speed;  // where the line meets angle 0
    out.start_s = first == 0 ? frames.front().time_s : start;
  }

  const FrameSequence& sequence_;
  const FromMotionOptions& options_;
  const DetectOptions& detect_;
  const RunContext& context_;
  MotionData data_;
  AngleSource source_ = AngleSource::kTimes;
  AngleLaw law_, chosen_;
  bool tells_turn_ = true;
  MotionState state_;
  MotionSolution solution_;
};

}  // namespace

OptionTable describe(FromMotionOptions& o) {
  OptionTable table;
  table
      .number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-1000.0, 1000.0},
              "Speed of the platter, counter-clockwise from above is positive; used where the "
              "recording does not show it")
      .flag("motion-angles", o.use_angles, "Start from the frames' own angles, if they have any")
      .flag("motion-table", o.use_table,
            "Start from the recording's turntable where no platter is seen")
      .number("motion-keys", o.key_frames, {3, 2000}, "Frames that others are compared with")
      .number("motion-angle-sigma", o.angle_sigma_rad, Quantity::kAngle, {1e-6, 1.0},
              "Standard deviation of the frames' own angles");
  return table;
}

Result<detail::MotionResult> detail::calibrate_one(const FrameSequence& sequence,
                                                   const FromMotionOptions& options,
                                                   const DetectOptions& detect, std::size_t most,
                                                   const RunContext& context) {
  Calibrator calibrator(sequence, options, detect, context);
  TURNSCAN_ASSIGN(Calibration found, calibrator.run());
  return calibrator.compared(std::move(found), most);
}

Result<Calibration> calibrate_from_motion(const FrameSequence& sequence,
                                          const FromMotionOptions& options,
                                          const DetectOptions& detect, const RunContext& context) {
  FromMotionOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  if (sequence.header().sensors.size() > 1)
    return detail::calibrate_several(sequence, options, detect, context);
  return Calibrator(sequence, options, detect, context).run();
}

}  // namespace turnscan
