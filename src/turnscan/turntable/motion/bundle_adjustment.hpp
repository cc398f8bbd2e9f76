#pragma once
// Adjusts all frames to one model of the object, which is itself unknown.

#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

struct BundleOptions {
  std::size_t max_frames = 1000;
  std::size_t max_knots = 232;     ///< between them, corrections of the angles are interpolated
  std::size_t max_surfels = 3200;  ///< approximate
  int iterations = 6;
  /// Only axis and heights, from pixels inside the outlines, which mixed pixels do not shift.
  bool axis_only = false;
  double view_shift_m = 0.0;  ///< as in AxisPrior
};

/// Refines a solution of solve_pairwise() for depth images. The model consists of surfels of the
/// object's surface, each with a normal and an unknown height along it; a frame's distance from a
/// surfel is measured where the frame's ray through the surfel intersects the frame's surface, so
/// that noise moves nothing sideways. Heights, axis, centre and angles are estimated jointly; the
/// heights are eliminated first (Schur complement, as in bundle adjustment: Triggs et al. 2000),
/// which leaves a dense system of the knots' angles and the axis. Pairs of views from different
/// sides, each of which appears rotated a little too far or too little, thus no longer accumulate
/// over the turn. If the frames have times, the evenness of the table's rotation is chosen by the
/// largest evidence (MacKay 1992, "Bayesian interpolation"); `prior.speed_walk` is not used.
/// Returns the start unchanged if hardly anything of the model is seen. Fails with kLibrary if the
/// system cannot be solved, with kCancelled.
Result<MotionSolution> adjust_bundle(const MotionData& data, const MotionSolution& start,
                                     const AnglePrior& prior, const BundleOptions& options,
                                     const RunContext& context);

}  // namespace turnscan::motion
