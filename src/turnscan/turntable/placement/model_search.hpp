#pragma once
// Which disturbances explain where the keyframes lie.

#include <turnscan/turntable/placement/evidence.hpp>

namespace turnscan::placement {

/// The frames of a sequence as the models see them.
struct ModelFrames {
  ModelScene scene;
  std::vector<ModelFrame> all;  ///< every frame of the sequence, as believed
};

ModelFrames model_frames(const std::vector<Pose>& believed, const Keyframes& keyframes);

/// A frame's pose with the models applied, in this order.
Pose placed(const ModelFrame& frame, const std::vector<DisturbanceModel>& models,
            const ModelScene& scene);

/// The models that the evidence is clear about, after the calibration's correction, which is first;
/// only that where there is nothing else. graph: of the keyframes, see solve_freely(). Fails with
/// kCancelled.
Result<std::vector<DisturbanceModel>> find_models(const Keyframes& keyframes,
                                                  const ModelFrames& frames, const PoseGraph& graph,
                                                  const RunContext& context);

}  // namespace turnscan::placement
