#pragma once
// Selects the disturbances that explain the poses of the keyframes.

#include <turnscan/turntable/placement/evidence.hpp>

namespace turnscan::placement {

/// The frames of a sequence as input of the models.
struct ModelFrames {
  ModelScene scene;
  std::vector<ModelFrame> all;  ///< every frame of the sequence, as assumed
};

ModelFrames model_frames(const std::vector<Pose>& believed, const Keyframes& keyframes);

/// A frame's pose with the models applied, in this order.
Pose placed(const ModelFrame& frame, const std::vector<DisturbanceModel>& models,
            const ModelScene& scene);

/// The models with clear evidence, preceded by the correction of the calibration, which comes
/// first; that alone if there is no other. graph: of the keyframes, see solve_freely(). Fails with
/// kCancelled.
Result<std::vector<DisturbanceModel>> find_models(const Keyframes& keyframes,
                                                  const ModelFrames& frames, const PoseGraph& graph,
                                                  const RunContext& context);

}  // namespace turnscan::placement
