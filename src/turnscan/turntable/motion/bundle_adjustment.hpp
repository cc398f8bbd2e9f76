#pragma once
// All frames against one model of what turns, which is an unknown itself.

#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

struct BundleOptions {
  std::size_t max_frames = 1000;
  std::size_t max_knots = 232;     ///< between which corrections of the angles are interpolated
  std::size_t max_surfels = 3200;  ///< about
  int iterations = 6;
  /// Only axis and heights, from pixels within the outlines, which mixed pixels do not shift.
  bool axis_only = false;
};

/// Refines a solution of solve_pairwise(), of depth images. The model is surfels of the object's
/// surface, each with a normal and an unknown height along it; a frame's distance from a surfel is
/// taken where the frame's ray through the surfel meets the frame's surface, so that noise moves
/// nothing sideways. Heights, axis, centre and angles are minimised together; the heights are
/// eliminated first (Schur complement; as in bundle adjustment, Triggs et al. 2000), which leaves
/// a dense system of the knots' angles and the axis. Pairs of views from different sides, each of
/// which seems to be turned a little too far or too little, no longer add up over the turn. How
/// evenly a table turns whose frames have times is the prior of largest evidence (MacKay 1992,
/// "Bayesian interpolation"); `prior.speed_walk` is not used.
/// Returns the start unchanged when hardly anything of the model is seen. Fails with kLibrary when
/// the system cannot be solved, kCancelled.
Result<MotionSolution> adjust_bundle(const MotionData& data, const MotionSolution& start,
                                     const AnglePrior& prior, const BundleOptions& options,
                                     const RunContext& context);

}  // namespace turnscan::motion
