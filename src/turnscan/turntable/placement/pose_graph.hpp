#pragma once
// Poses of the keyframes without any assumption about their motion.

#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/placement/pair_constraints.hpp>

namespace turnscan::placement {

struct PoseGraph {
  std::vector<Pose> poses;                  ///< T_table_sensor of each keyframe
  std::vector<PairConstraint> constraints;  ///< at these poses
  double scale_m = 0.0;                     ///< robust standard deviation of a residual
};

/// Least squares over pairs of keyframes with six unknowns each, starting at the assumed poses; a
/// weak prior fixes what the object's shape does not determine. Uses successive frames first, then
/// also those that close a turn. Fails with kTooFewPoints if the frames have too little in common,
/// and with kCancelled.
Result<PoseGraph> solve_freely(const Keyframes& frames, const std::vector<Pose>& start,
                               const RunContext& context);

/// The constraints of these pairs, in order.
std::vector<PairConstraint> constrain_all(const Keyframes& frames, const std::vector<Pose>& poses,
                                          const std::vector<FramePair>& pairs,
                                          const PairWeighting& weighting);

/// Robust standard deviation of the residuals.
double scale_of(const std::vector<PairConstraint>& constraints);

}  // namespace turnscan::placement
