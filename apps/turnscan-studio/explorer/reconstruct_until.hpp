#pragma once

#include <string>
#include <turnscan/reconstruction/pipeline.hpp>
#include <variant>

namespace turnscan::studio {

/// Runs the pipeline up to a stage and returns the stage's cloud. If the method has no stage of
/// that name among saveable_stages(SurfaceMethod), runs to the end and returns the whole
/// reconstruction. Fails as reconstruct() does.
Result<std::variant<PointCloud, Reconstruction>> reconstruct_until(
    const std::string& stage, const FrameSequence& frames, const ReconstructOptions& options,
    const RunContext& context);

}  // namespace turnscan::studio
