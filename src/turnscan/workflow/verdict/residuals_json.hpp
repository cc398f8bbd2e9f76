#pragma once
// How frames fit their meshes, in a report's JSON.

#include <nlohmann/json_fwd.hpp>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <vector>

namespace turnscan::workflow {

/// Puts "frame_residuals" into each of report["objects"] of which something is known: columns
/// frame, sensor, pass, time_s (null: not known), off_mm, spread_mm and outward_mm, a value a
/// frame.
void put_frame_residuals(const std::vector<std::vector<FrameResidual>>& residuals,
                         nlohmann::ordered_json& report);

}  // namespace turnscan::workflow
