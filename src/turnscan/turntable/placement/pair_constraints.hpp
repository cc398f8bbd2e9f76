#pragma once
// What the overlap of two frames says of where they lie to each other.

#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/placement/keyframes.hpp>

namespace turnscan::placement {

using motion::FramePair, motion::PairWeighting;

/// Normal equations of the twist of `from` minus that of `to`, from point-to-plane distances.
struct PairConstraint : estimation::NormalEquations<6>, motion::PairSums {
  FramePair pair{0, 0};
  double normal_noise = 0.0;  ///< of the normals, squared and summed as the rows are
};

/// The samples of pair.from against the surface of pair.to with the frames at `poses`.
PairConstraint constrain(const Keyframes& frames, const std::vector<Pose>& poses,
                         const FramePair& pair, const PairWeighting& weighting);

/// Sets frames.shown: without directions in which the whole object slides on itself, as a cylinder
/// about its axis, but for what noisy normals make of it.
void find_shown(Keyframes& frames, const std::vector<PairConstraint>& constraints);

/// How badly two frames fit each other: mean truncated squared distance, 0 to 1, where points
/// without a counterpart count 0.6.
double pair_mismatch(const Keyframes& frames, const std::vector<Pose>& poses,
                     const FramePair& pair);

/// The mean of all pairs.
double mismatch(const Keyframes& frames, const std::vector<Pose>& poses);

/// Frames that follow each other, by 1, 2 and 4, less than a sixth of a turn apart.
std::vector<FramePair> successive_pairs(const Keyframes& frames, const std::vector<Pose>& poses);

/// Frames far apart in order that show about the same view: what closes a turn.
std::vector<FramePair> closing_pairs(const Keyframes& frames, const std::vector<Pose>& poses);

/// Both.
std::vector<FramePair> all_pairs(const Keyframes& frames, const std::vector<Pose>& poses);

}  // namespace turnscan::placement
