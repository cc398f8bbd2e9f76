#pragma once
// How evenly the table turns is shown by the data, too: the prior of largest evidence (MacKay 1992,
// "Bayesian interpolation").

#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

/// Sets prior.speed_walk to the steadiest of several that is about as probable as the most probable
/// one, and state to the solution with the best. solution: of the same state, whose scale of the
/// residuals is kept. Fails as solve_pairwise.
Result<> choose_speed_walk(const MotionData& data, const MotionSolution& solution,
                           SolveOptions options, AnglePrior& prior, MotionState& state,
                           const RunContext& context);

}  // namespace turnscan::motion
