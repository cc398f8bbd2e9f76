#pragma once
// From the first guess to the most probable axis and angles.

#include <turnscan/turntable/motion/initialisation.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

struct RefinedMotion {
  AngleSource source = AngleSource::kTimes;
  bool turn_observable = true;  ///< else the angles are those of the prior
  /// False: without the platter the axis is clearly another.
  bool platter_fits = true;
  AnglePrior prior;
  MotionSolution solution;
};

/// Pairs of frames coarse to fine, the motor's phases and evenness in between, then bundle
/// adjustment where there are enough depth images. Fails as solve_pairwise and adjust_bundle,
/// and with kMissingData when the object looks the same from all sides and no speed is known.
Result<RefinedMotion> refine_motion(const MotionData& data, InitialMotion start,
                                    const RunContext& context);

}  // namespace turnscan::motion
