#pragma once
// Ground truth of a simulated recording.

#include <filesystem>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/simulator/virtual_passes.hpp>
#include <vector>

namespace turnscan {

/// Writes folder/truth: object.ply (table frame, platter at angle 0; none for the empty table; for
/// further passes object-pass1.ply, ...), poses.csv (every frame's angle and T_table_sensor with
/// the rotation removed), calibration.json (as saved by turnscan calibrate), truth.json (poses of
/// the sensors and of the object) and scene.toml (the description as used). On failure the folder
/// is removed. placed: for each pass; empty for the empty table.
Result<> write_truth(const std::filesystem::path& folder, const VirtualPasses& scan,
                     const SceneDescription& scene, const std::vector<PlacedObject>& placed);

}  // namespace turnscan
