#pragma once
// What the simulator knows and a real recording never says, beside the recording.

#include <filesystem>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/simulator/virtual_passes.hpp>
#include <vector>

namespace turnscan {

/// Writes folder/truth: object.ply (table frame, platter at angle 0; none for the empty table; of
/// further passes object-pass1.ply, ...), poses.csv (every frame's angle and T_table_sensor, the
/// turn taken back), calibration.json (as turnscan calibrate saves it), truth.json (poses of the
/// sensors and of the object) and scene.toml (the description as it was used). On failure nothing
/// of it remains. placed: for each pass; none for the empty table.
Result<> write_truth(const std::filesystem::path& folder, const VirtualPasses& scan,
                     const SceneDescription& scene, const std::vector<PlacedObject>& placed);

}  // namespace turnscan
