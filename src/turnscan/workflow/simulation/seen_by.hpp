#pragma once

#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/rays/scene.hpp>

namespace turnscan {

/// Test for evaluate(): whether any frame of the sequence sees a point of the scene's surface
/// (seen_mask()). It refers to its arguments, which must outlive it.
SeenTest seen_by(const Scene& scene, const FrameSequence& sequence, const RunContext& context);

}  // namespace turnscan
