#include <algorithm>
#include <turnscan/turntable/motion/evidence.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>

namespace turnscan::motion {

namespace {

constexpr double kClearEvidence = 8.0;  ///< difference of MotionSolution::minus_2_log_evidence

}  // namespace

Result<> choose_speed_walk(const MotionData& data, const MotionSolution& solution,
                           SolveOptions options, AnglePrior& prior, MotionState& state,
                           const RunContext& context) {
  const auto pairs = select_pairs(data, state.angle, false);
  options.scale_m = solution.scale_m;
  options.variance_m2 = solution.variance_m2;
  options.iterations = 4;
  options.reach_m = std::max(0.004, 12.0 * solution.scale_m);
  std::optional<MotionSolution> best;
  double speed_walk = prior.speed_walk;
  for (const double share : {2e-4, 1e-3, 2.5e-3, 6e-3, 1.5e-2}) {
    prior.speed_walk = share;
    TURNSCAN_ASSIGN(MotionSolution tried,
                    solve_pairwise(data, state, pairs, prior, options, context));
    // The steadiest of those that are about as probable.
    if (best && best->minus_2_log_evidence <= tried.minus_2_log_evidence + kClearEvidence) continue;
    best = std::move(tried);
    speed_walk = share;
  }
  prior.speed_walk = speed_walk;
  state = best->state;
  return {};
}

}  // namespace turnscan::motion
