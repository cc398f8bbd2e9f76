#pragma once
// Where the keyframes lie when nothing is assumed of their motion.

#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/placement/pair_constraints.hpp>

namespace turnscan::placement {

struct PoseGraph {
  std::vector<Pose> poses;                  ///< T_table_sensor of each keyframe
  std::vector<PairConstraint> constraints;  ///< at these poses
  double scale_m = 0.0;                     ///< robust standard deviation of a residual
};

/// Least squares over pairs of keyframes, six unknowns each, from the believed poses on; a weak
/// prior holds what the object's shape does not show. First frames that follow each other, then
/// those, too, that close a turn. Fails with kTooFewPoints when the frames have too little in
/// common, and kCancelled.
Result<PoseGraph> solve_freely(const Keyframes& frames, const std::vector<Pose>& start,
                               const RunContext& context);

/// The constraints of these pairs, in order.
std::vector<PairConstraint> constrain_all(const Keyframes& frames, const std::vector<Pose>& poses,
                                          const std::vector<FramePair>& pairs,
                                          const PairWeighting& weighting);

/// Robust standard deviation of the residuals.
double scale_of(const std::vector<PairConstraint>& constraints);

}  // namespace turnscan::placement
