#pragma once
// What the frames say of the motor: when the table starts, stops and stands, and how evenly it
// turns.

#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

/// Marks the frames in prior.transient: where the speed over about a second is far from the median,
/// the table starts or stops. Sets prior.speed_rad_s to the median. The frames must have times.
/// Returns whether any was marked.
bool find_transients(const MotionData& data, const MotionState& state, AnglePrior& prior);

/// Marks the frames in prior.still: how long the table stands before it starts and after it
/// stopped, until an angle is farther from the mean of those before than it can be by chance. What
/// the table turns by meanwhile is less than can be seen. Needs prior.transient.
void find_standstills(const MotionState& state, AnglePrior& prior);

/// Marks in prior.slips where a table that turns evenly before and after, and slips between two key
/// frames, is clearly more probable than one that turns unevenly, and sets state to the solution
/// with them. At most three slips of about a degree or more, and only where views on both sides
/// show the same surface: else prior.unjoined is set; prior.transient is cleared there. solution,
/// options: as of choose_speed_walk. Needs prior.speed_rad_s. Fails as solve_pairwise.
Result<> find_slips(const MotionData& data, const MotionSolution& solution, SolveOptions options,
                    AnglePrior& prior, MotionState& state, const RunContext& context);

/// Sets prior.speed_walk to the steadiest of several that is about as probable as the most probable
/// one (the prior of largest evidence: MacKay 1992, "Bayesian interpolation"), and state to the
/// solution with the best. solution: of the same state, whose scale of the residuals is kept. Fails
/// as solve_pairwise.
Result<> choose_speed_walk(const MotionData& data, const MotionSolution& solution,
                           SolveOptions options, AnglePrior& prior, MotionState& state,
                           const RunContext& context);

}  // namespace turnscan::motion
