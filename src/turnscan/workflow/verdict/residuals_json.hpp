#pragma once
// The fit of frames to their meshes, in a report's JSON.

#include <nlohmann/json_fwd.hpp>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <vector>

namespace turnscan::workflow {

/// Adds "frame_residuals" to each of report["objects"] that has residuals: columns frame, sensor,
/// pass, time_s (null: not known), off_mm, spread_mm and outward_mm, one value per frame.
void put_frame_residuals(const std::vector<std::vector<FrameResidual>>& residuals,
                         nlohmann::ordered_json& report);

}  // namespace turnscan::workflow
