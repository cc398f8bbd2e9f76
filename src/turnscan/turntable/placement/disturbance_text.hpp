#pragma once
// Disturbances in words.

#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <turnscan/turntable/placement/model_search.hpp>

namespace turnscan::placement {

/// What a model stands for. models: all of them, in order; which: the one to tell.
Disturbance tell(const FrameSequence& sequence, const ModelFrames& frames,
                 const std::vector<DisturbanceModel>& models, std::size_t which);

/// Frames from `first` to `last` that something hides.
Disturbance tell_hidden(const FrameSequence& sequence, std::size_t first, std::size_t last);

}  // namespace turnscan::placement
