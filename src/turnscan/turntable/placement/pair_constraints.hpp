#pragma once
// Constraints on the relative pose of two frames from their overlap.

#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/placement/keyframes.hpp>

namespace turnscan::placement {

using motion::FramePair, motion::PairWeighting;

/// Normal equations of the twist of `from` minus that of `to`, from point-to-plane distances.
struct PairConstraint : estimation::NormalEquations<6>, motion::PairSums {
  FramePair pair{0, 0};
  double normal_noise = 0.0;  ///< of the normals, squared and summed as the rows are
};

/// Compares the samples of pair.from with the surface of pair.to, with the frames at `poses`.
PairConstraint constrain(const Keyframes& frames, const std::vector<Pose>& poses,
                         const FramePair& pair, const PairWeighting& weighting);

/// Sets frames.shown: excludes directions in which the whole object slides on itself, as a cylinder
/// about its axis, allowing for noise of the normals.
void find_shown(Keyframes& frames, const std::vector<PairConstraint>& constraints);

/// Misfit of two frames: mean truncated squared distance, 0 to 1, where points without a
/// counterpart count 0.6.
double pair_mismatch(const Keyframes& frames, const std::vector<Pose>& poses,
                     const FramePair& pair);

/// The mean over all pairs.
double mismatch(const Keyframes& frames, const std::vector<Pose>& poses);

/// Frames that follow each other by 1, 2 and 4, less than a sixth of a turn apart.
std::vector<FramePair> successive_pairs(const Keyframes& frames, const std::vector<Pose>& poses);

/// Frames far apart in order with about the same viewpoint, which close a turn.
std::vector<FramePair> closing_pairs(const Keyframes& frames, const std::vector<Pose>& poses);

/// Successive and closing pairs.
std::vector<FramePair> all_pairs(const Keyframes& frames, const std::vector<Pose>& poses);

}  // namespace turnscan::placement
