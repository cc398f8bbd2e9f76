#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/turntable/motion/initial_guess.hpp>
#include <turnscan/turntable/motion/initialisation.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>
#include <turnscan/turntable/motion/robust.hpp>

namespace turnscan::motion {

namespace {

class Initialisation {
 public:
  Initialisation(const MotionData& data, const SequenceHeader& header,
                 const FromMotionOptions& options, const RunContext& context)
      : data_(data), options_(options), context_(context), source_(source_of_angles()) {
    if (options.use_table) table_ = header.turntable;
  }

  Result<InitialMotion> run() {
    InitialMotion best;
    best.source = source_;
    double least = 2.0;
    for (MotionState& state : candidate_axes(data_, table_)) {
      TURNSCAN_TRY(context_.check());
      TURNSCAN_TRY(start_angles(state));
      TURNSCAN_ASSIGN(const MotionSolution rough, solve_roughly(state));
      const double cost = mean_pair_cost(data_, rough.state);
      if (cost < least) {
        least = cost;
        best.state = rough.state;
        best.prior = prior_;
      }
    }
    best.turn_observable = turn_observable_;
    return best;
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

  Result<MotionSolution> solve_roughly(const MotionState& state) {
    SolveOptions options;
    options.iterations = 6;
    options.reach_m = 0.03;
    options.floor_m = 0.004;
    options.stride = coarse_stride(data_, 6);
    options.hold_angles = !turn_observable_;
    auto rough = solve_pairwise(data_, state, select_pairs(data_, state.angle, false), prior_,
                                options, context_);
    if (rough || rough.error().code == ErrorCode::kCancelled) return rough;
    MotionSolution none;
    none.state = state;
    return none;
  }

  /// Sets the prior and the angles of a candidate axis.
  Result<> start_angles(MotionState& state) {
    prior_ = {};
    turn_observable_ =
        source_ == AngleSource::kNothing || turn_information(data_, state) > kLeastTurnInformation;
    if (source_ == AngleSource::kTimes) return start_from_times(state);
    if (source_ == AngleSource::kAngles) {
      start_from_angles(state);
    } else {
      search_turns(data_, state);
    }
    return {};
  }

  Result<> start_from_times(MotionState& state) {
    double speed = guess_speed(data_, state);
    if (!turn_observable_) {
      std::optional<double> known = options_.speed_rad_s;
      if (!known && table_) known = table_->speed_rad_s;
      if (!known)
        return fail(ErrorCode::kMissingData,
                    "motion: the object looks the same from all sides, so that its speed cannot be "
                    "seen; give --speed");
      speed = *known;
      prior_.stated_rad_s = known;
    }
    prior_.timed = true;
    prior_.speed_rad_s = speed;
    const double t0 = data_.frames.front().time_s;
    for (std::size_t i = 0; i < state.angle.size(); ++i)
      state.angle[i] = speed * (data_.frames[i].time_s - t0);
    if (turn_observable_) track_angles(data_, state, 0.3);
    return {};
  }

  /// The list of angles may count the other way round.
  void start_from_angles(MotionState& state) {
    prior_.nominal_sigma_rad = options_.angle_sigma_rad;
    std::array<double, 2> cost{};
    std::array<MotionState, 2> states{state, state};
    for (const int k : {0, 1}) {
      prior_.nominal_sign = k == 0 ? 1.0 : -1.0;
      const double zero = *data_.frames[0].nominal_rad;
      for (std::size_t i = 0; i < state.angle.size(); ++i)
        states[std::size_t(k)].angle[i] =
            prior_.nominal_sign * (*data_.frames[i].nominal_rad - zero);
      cost[std::size_t(k)] = mean_pair_cost(data_, states[std::size_t(k)]);
    }
    const int best = cost[1] < 0.8 * cost[0] ? 1 : 0;
    prior_.nominal_sign = best == 0 ? 1.0 : -1.0;
    state = states[std::size_t(best)];
  }

  const MotionData& data_;
  const FromMotionOptions& options_;
  const RunContext& context_;
  std::optional<TurntableInfo> table_;  ///< the recording's, where it is to be used
  AngleSource source_;
  AnglePrior prior_;
  bool turn_observable_ = true;
};

}  // namespace

Result<InitialMotion> initialise_motion(const MotionData& data, const SequenceHeader& header,
                                        const FromMotionOptions& options,
                                        const RunContext& context) {
  return Initialisation(data, header, options, context).run();
}

}  // namespace turnscan::motion
