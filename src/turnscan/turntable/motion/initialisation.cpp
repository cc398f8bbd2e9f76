#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/turntable/clouds/cloud_convention.hpp>
#include <turnscan/turntable/motion/axis_search.hpp>
#include <turnscan/turntable/motion/initial_guess.hpp>
#include <turnscan/turntable/motion/initialisation.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

namespace {

constexpr std::size_t kMaxStarts = 6;     ///< that are solved carefully
constexpr std::size_t kSieveStride = 12;  ///< of the samples by which the others are judged
/// Logarithm of the ratio above which two speeds are different.
constexpr double kMisled = 0.15;

class Initialisation {
 public:
  Initialisation(const MotionData& data, const SequenceHeader& header,
                 const FromMotionOptions& options, const RunContext& context)
      : data_(data),
        viewpoint_(header.sensors.front().viewpoint),
        options_(options),
        context_(context),
        source_(source_of_angles()) {
    if (options.use_table) table_ = header.turntable;
    known_speed_ = options.speed_rad_s;
    if (!known_speed_ && table_) known_speed_ = table_->speed_rad_s;
    if (source_ == AngleSource::kTimes) recurrence_ = recurrence_costs(data);
  }

  Result<InitialMotion> run() {
    TURNSCAN_ASSIGN(std::vector<Start> starts, find_starts());
    const Start* best = &starts.front();
    double least = std::numeric_limits<double>::infinity();
    for (Start& start : starts) {
      TURNSCAN_TRY(solve_roughly(start, coarse_stride(data_, 6), 6));
      set_upright(start.state, start.prior);
      const double cost = cost_of(start);
      if (cost < least) least = cost, best = &start;
    }
    return InitialMotion{best->state, best->prior, source_, known_speed_};
  }

 private:
  /// An axis that points down turns in the opposite direction.
  void set_upright(MotionState& state, AnglePrior& prior) const {
    if (data_.platter || table_ || up_along(state, prior) >= 0.0) return;
    state.axis = -state.axis;
    for (double& angle : state.angle) angle = -angle;
    prior.speed_rad_s = -prior.speed_rad_s;
    prior.nominal_sign = -prior.nominal_sign;
  }

  /// Negative if the axis points down. Clouds lie in any way; where they do not show what is up, it
  /// is the side from which stated angles count counter-clockwise, or else as for cameras.
  double up_along(const MotionState& state, const AnglePrior& prior) const {
    if (!data_.projective) {
      if (const double up = upward(data_, viewpoint_, state.axis); up != 0.0) return up;
      if (source_ == AngleSource::kAngles) return prior.nominal_sign;
    }
    return -state.axis.y();
  }

  AngleSource source_of_angles() const {
    const auto has_angle = [](const MotionFrame& f) { return f.nominal_rad.has_value(); };
    const auto has_time = [](const MotionFrame& f) { return std::isfinite(f.time_s); };
    const auto& frames = data_.frames;
    if (options_.use_angles && std::all_of(frames.begin(), frames.end(), has_angle))
      return AngleSource::kAngles;
    if (std::all_of(frames.begin(), frames.end(), has_time)) return AngleSource::kTimes;
    return AngleSource::kNothing;
  }

  /// An initial axis with angles.
  struct Start {
    MotionState state;
    AnglePrior prior;
  };

  Result<std::vector<Start>> find_starts() const {
    std::vector<Start> starts;
    if (source_ == AngleSource::kAngles && !data_.projective && !table_) {
      TURNSCAN_TRY(search_everywhere(starts));
      return starts;
    }
    std::optional<Error> failure;  // of the first axis without a usable speed
    for (const MotionState& axis : candidate_axes(data_, table_)) {
      TURNSCAN_TRY(context_.check());
      auto begun = start_angles(axis, starts);
      if (!begun && !failure) failure = std::move(begun).error();
    }
    if (starts.empty()) return tl::unexpected<Error>(*failure);
    TURNSCAN_TRY(keep_promising(starts));
    return starts;
  }

  /// Refines the start's axis and angles; leaves them unchanged if no equation helps.
  Result<> solve_roughly(Start& start, std::size_t stride, int iterations,
                         bool hold_angles = false) const {
    SolveOptions options;
    options.hold_angles = hold_angles;
    options.iterations = iterations;
    options.reach_m = 0.03;
    options.floor_m = 0.004;
    options.stride = stride;
    auto rough = solve_pairwise(data_, start.state, select_pairs(data_, start.state.angle, false),
                                start.prior, options, context_);
    if (rough) {
      start.state = std::move(rough->state);
    } else if (rough.error().code == ErrorCode::kCancelled) {
      return tl::unexpected<Error>(rough.error());
    }
    return {};
  }

  /// The angles' own sign takes precedence if the other fits hardly better.
  double cost_of(const Start& start) const {
    return mean_pair_cost(data_, start.state) * (start.prior.nominal_sign < 0.0 ? 1.25 : 1.0);
  }

  /// Keeps those of many starts that fit best after a quick evaluation.
  Result<> keep_promising(std::vector<Start>& starts) const {
    if (starts.size() <= kMaxStarts) return {};
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      TURNSCAN_TRY(solve_roughly(starts[i], kSieveStride, 3));
      order.emplace_back(cost_of(starts[i]), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<Start> kept;
    for (std::size_t k = 0; k < kMaxStarts; ++k) kept.push_back(std::move(starts[order[k].second]));
    starts = std::move(kept);
    return {};
  }

  /// Adds the starts about an axis. Fails with kMissingData if no speed is observed and none is
  /// known.
  Result<> start_angles(const MotionState& axis, std::vector<Start>& starts) const {
    const Start start{axis, {}};
    if (source_ == AngleSource::kTimes) return start_from_times(start, starts);
    if (source_ == AngleSource::kAngles) {
      start_from_angles(start, starts);
      return {};
    }
    starts.push_back(start);
    search_turns(data_, starts.back().state);
    return {};
  }

  Result<> start_from_times(Start start, std::vector<Start>& starts) const {
    double seen = guess_speed(data_, start.state);
    const auto recurs =
        seen != 0.0 ? recurrence_speed(data_, recurrence_, start.state, seen) : std::nullopt;
    // If the axis is wrong, neighbouring frames fit best with too small a rotation.
    const bool misled = recurs && std::abs(std::log(*recurs / seen)) > kMisled;
    if (misled) seen = *recurs;
    const double speed = seen != 0.0 ? seen : known_speed_.value_or(0.0);
    if (speed == 0.0)
      return fail(ErrorCode::kMissingData,
                  "motion: no speed was found at which the frames fit; check that the table "
                  "turned and that the frames' times increase, or give --speed");
    start.prior.timed = true;
    start.prior.speed_rad_s = speed;
    const double t0 = data_.frames.front().time_s;
    for (std::size_t i = 0; i < start.state.angle.size(); ++i)
      start.state.angle[i] = speed * (data_.frames[i].time_s - t0);
    if (misled) TURNSCAN_TRY(solve_roughly(start, coarse_stride(data_, 6), 6, true));
    if (seen != 0.0) track_angles(data_, start.state, misled ? 0.05 : 0.3);
    starts.push_back(std::move(start));
    return {};
  }

  /// The list of angles may have the opposite sign, which an approximate axis cannot determine yet.
  void start_from_angles(const Start& start, std::vector<Start>& starts) const {
    const std::vector<double> told = told_angles();
    for (const double sign : {1.0, -1.0}) starts.push_back(start_with(start.state, told, sign));
  }

  Start start_with(const MotionState& axis, const std::vector<double>& told, double sign) const {
    Start out{axis, {}};
    out.prior.nominal_sigma_rad = options_.angle_sigma_rad;
    out.prior.nominal_sign = sign;
    out.state.angle = told;
    for (double& angle : out.state.angle) angle *= sign;
    return out;
  }

  /// Stated angles since the first frame.
  std::vector<double> told_angles() const {
    std::vector<double> out;
    for (const MotionFrame& frame : data_.frames)
      out.push_back(*frame.nominal_rad - *data_.frames[0].nominal_rad);
    return out;
  }

  /// Scans that are far apart can only be aligned from a close start.
  Result<> search_everywhere(std::vector<Start>& starts) const {
    const std::vector<double> told = told_angles();
    TURNSCAN_ASSIGN(const auto trials, search_axes(data_, told, kMaxStarts, context_));
    for (const AxisTrial& trial : trials)
      starts.push_back(start_with(trial.state, told, trial.sign));
    return {};
  }

  const MotionData& data_;
  const Viewpoint viewpoint_;
  const FromMotionOptions& options_;
  const RunContext& context_;
  std::optional<TurntableInfo> table_;  ///< the recording's, if it is to be used
  std::optional<double> known_speed_;
  AngleSource source_;
  std::vector<double> recurrence_;  ///< for frames with times only
};

}  // namespace

Result<InitialMotion> initialise_motion(const MotionData& data, const SequenceHeader& header,
                                        const FromMotionOptions& options,
                                        const RunContext& context) {
  return Initialisation(data, header, options, context).run();
}

}  // namespace turnscan::motion
