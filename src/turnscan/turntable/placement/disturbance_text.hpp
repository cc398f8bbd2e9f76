#pragma once
// Descriptions of disturbances.

#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <turnscan/turntable/placement/model_search.hpp>

namespace turnscan::placement {

/// The disturbance that a model represents. models: all of them, in order; which: the index of the
/// one described.
Disturbance tell(const FrameSequence& sequence, const ModelFrames& frames,
                 const std::vector<DisturbanceModel>& models, std::size_t which);

/// A disturbance for the frames `first` to `last`, in which something occludes the object.
Disturbance tell_hidden(const FrameSequence& sequence, std::size_t first, std::size_t last);

}  // namespace turnscan::placement
