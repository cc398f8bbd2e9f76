#pragma once
// All frames against one model of what turns, which is an unknown itself. Internal to turntable:
// not installed.

#include <turnscan/turntable/motion_solve.hpp>

namespace turnscan::detail {

struct ModelOptions {
  std::size_t most_frames = 1000;
  std::size_t most_knots = 232;    ///< between which corrections of the angles are interpolated
  std::size_t most_places = 3200;  ///< of the object's surface, about
  int iterations = 6;
};

/// Refines a solution of solve_motion(), of depth images. The model is places of the object's
/// surface, each with a normal and an unknown height along it; a frame's distance from a place is
/// taken where the frame's ray through the place meets the frame's surface, so that noise moves
/// nothing sideways. Heights, axis, centre and angles are minimised together; the heights are
/// eliminated first (Schur complement; as in bundle adjustment, Triggs et al. 2000), which leaves
/// a dense system of the knots' angles and the axis. Pairs of views from different sides, each of
/// which seems to be turned a little too far or too little, no longer add up over the turn. How
/// evenly a table turns whose frames have times is the law of largest evidence (MacKay 1992,
/// "Bayesian interpolation"); `law.wander` is not used.
/// Returns the start unchanged when hardly anything of the model is seen. Fails with kLibrary when
/// the system cannot be solved, kCancelled.
Result<MotionSolution> solve_model(const MotionData& data, const MotionSolution& start,
                                   const AngleLaw& law, const ModelOptions& options,
                                   const RunContext& context);

}  // namespace turnscan::detail
