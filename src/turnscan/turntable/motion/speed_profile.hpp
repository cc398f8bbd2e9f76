#pragma once
// The motor's motion as estimated from the frames: when the table starts, stops and stands still,
// and how evenly it turns.

#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

/// Marks the frames in prior.transient in which the table starts or stops: those where the speed
/// over about a second is far from the median. Sets prior.speed_rad_s to the median. The frames
/// must have times. Returns whether any was marked.
bool find_transients(const MotionData& data, const MotionState& state, AnglePrior& prior);

/// Marks the frames in prior.still in which the table stands before it starts and after it stopped,
/// up to the first angle that differs from the mean of those before by more than chance. Its
/// rotation meanwhile is too small to be detected. Needs prior.transient.
void find_standstills(const MotionState& state, AnglePrior& prior);

/// Marks slips in prior.slips where a table that turns evenly before and after, and slips between
/// two key frames, is clearly more probable than one that turns unevenly, and sets state to the
/// solution with them. Finds at most three slips of about a degree or more, and only if views on
/// both sides show the same surface; otherwise prior.unjoined is set. Clears prior.transient there.
/// solution, options: as of choose_speed_walk. Needs prior.speed_rad_s. Fails as solve_pairwise.
Result<> find_slips(const MotionData& data, const MotionSolution& solution, SolveOptions options,
                    AnglePrior& prior, MotionState& state, const RunContext& context);

/// Sets prior.speed_walk to the steadiest of several candidates that is about as probable as the
/// most probable one (the prior of largest evidence: MacKay 1992, "Bayesian interpolation"), and
/// state to the solution with the best. solution: of the same state; the scale of its residuals is
/// kept. Fails as solve_pairwise.
Result<> choose_speed_walk(const MotionData& data, const MotionSolution& solution,
                           SolveOptions options, AnglePrior& prior, MotionState& state,
                           const RunContext& context);

}  // namespace turnscan::motion
