#pragma once
// Determines when a disturbance happened from the frames between two keyframes.

#include <turnscan/turntable/placement/model_search.hpp>

namespace turnscan::placement {

/// Sets `first` of the models that are a step to the first frame that fits better with the step
/// than without. Fails with kCancelled and with the errors of reading.
Result<> find_moments(const FrameSequence& sequence, const std::vector<Pose>& believed,
                      const Keyframes& keyframes, const ModelFrames& frames,
                      std::vector<DisturbanceModel>& models, const RunContext& context);

}  // namespace turnscan::placement
