#include <algorithm>
#include <turnscan/turntable/motion/bundle_adjustment.hpp>
#include <turnscan/turntable/motion/evidence.hpp>
#include <turnscan/turntable/motion/initial_guess.hpp>
#include <turnscan/turntable/motion/motor_phases.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/refinement.hpp>
#include <turnscan/turntable/motion/robust.hpp>

namespace turnscan::motion {

namespace {

/// Fewer views, far apart, have too little in common for a model of the surface.
constexpr std::size_t kLeastBundleFrames = 24;
constexpr std::size_t kLeastPhaseFrames = 24, kLeastEvidenceFrames = 12;

class Refinement {
 public:
  Refinement(const MotionData& data, InitialMotion start, const FromMotionOptions& options,
             const RunContext& context)
      : data_(data), options_(options), context_(context), state_(std::move(start.state)) {
    out_.source = start.source;
    out_.turn_observable = start.turn_observable;
    out_.prior = std::move(start.prior);
  }

  Result<RefinedMotion> run() {
    SolveOptions options;
    options.reach_m = 0.02;
    options.floor_m = 0.002;
    options.iterations = 8;
    options.stride = coarse_stride(data_, 4);
    TURNSCAN_TRY(solve(options, false));
    TURNSCAN_TRY(judge_turn(options));
    TURNSCAN_TRY(fit_motor(options));
    options.stride = 1;
    options.iterations = 5;
    options.reach_m = 0.01;
    options.floor_m = 0.0;
    TURNSCAN_TRY(solve(options, false));
    // At last with all frames; the pairs follow the angles.
    options.iterations = 3;
    options.covariance = true;
    TURNSCAN_TRY(solve(options, true));
    // Where the angles are the prior's, pairs of views do not drift.
    if (data_.projective && out_.turn_observable && data_.keys.size() >= kLeastBundleFrames) {
      TURNSCAN_ASSIGN(out_.solution, adjust_bundle(data_, out_.solution, out_.prior, {}, context_));
    }
    return std::move(out_);
  }

 private:
  Result<> solve(SolveOptions options, bool all_frames) {
    options.hold_angles = !out_.turn_observable;
    const auto pairs = select_pairs(data_, state_.angle, all_frames);
    TURNSCAN_ASSIGN(out_.solution,
                    solve_pairwise(data_, state_, pairs, out_.prior, options, context_));
    state_ = out_.solution.state;
    context_.advance();
    return {};
  }

  /// Whether the turn can be seen, now that the axis is known better.
  Result<> judge_turn(const SolveOptions& options) {
    const bool was_observable = out_.turn_observable;
    out_.turn_observable = out_.source == AngleSource::kNothing ||
                           turn_information(data_, state_) > kLeastTurnInformation;
    if (!was_observable || out_.turn_observable) return {};
    reset_to_prior();
    return solve(options, false);
  }

  /// The shape says nothing about the turn: back to what times or angles say.
  void reset_to_prior() {
    AnglePrior& prior = out_.prior;
    const double t0 = data_.frames.front().time_s;
    for (std::size_t i = 0; i < state_.angle.size(); ++i) {
      if (out_.source == AngleSource::kTimes)
        state_.angle[i] =
            options_.speed_rad_s.value_or(prior.speed_rad_s) * (data_.frames[i].time_s - t0);
      if (out_.source == AngleSource::kAngles)
        state_.angle[i] =
            prior.nominal_sign * (*data_.frames[i].nominal_rad - *data_.frames[0].nominal_rad);
    }
    if (options_.speed_rad_s) prior.stated_rad_s = options_.speed_rad_s;
  }

  /// The motor's phases and how evenly it turns, where the frames have times and show the turn.
  Result<> fit_motor(SolveOptions& options) {
    if (out_.source != AngleSource::kTimes || !out_.turn_observable) return {};
    if (data_.keys.size() >= kLeastPhaseFrames && find_transients(data_, state_, out_.prior)) {
      options.iterations = 4;
      options.reach_m = std::max(0.004, 12.0 * out_.solution.scale_m);
      TURNSCAN_TRY(solve(options, false));
      find_standstills(state_, out_.prior);
    }
    if (data_.keys.size() < kLeastEvidenceFrames) return {};
    return choose_speed_walk(data_, out_.solution, options, out_.prior, state_, context_);
  }

  const MotionData& data_;
  const FromMotionOptions& options_;
  const RunContext& context_;
  MotionState state_;
  RefinedMotion out_;
};

}  // namespace

Result<RefinedMotion> refine_motion(const MotionData& data, InitialMotion start,
                                    const FromMotionOptions& options, const RunContext& context) {
  return Refinement(data, std::move(start), options, context).run();
}

}  // namespace turnscan::motion
