#pragma once
// Refines the initial guess to the most probable axis and angles.

#include <turnscan/turntable/motion/initialisation.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

struct RefinedMotion {
  AngleSource source = AngleSource::kTimes;
  bool turn_observable = true;  ///< if false, the angles are those of the prior
  /// False: the axis estimated without the platter differs clearly from the platter's.
  bool platter_fits = true;
  AnglePrior prior;
  MotionSolution solution;
};

/// Solves pairs of frames coarse to fine, estimates the motor's phases and evenness in between,
/// then runs bundle adjustment if there are enough depth images. Fails as solve_pairwise and
/// adjust_bundle, and with kMissingData if the object looks the same from all sides and no speed is
/// known.
Result<RefinedMotion> refine_motion(const MotionData& data, InitialMotion start,
                                    const RunContext& context);

}  // namespace turnscan::motion
