#pragma once
// What the Simulator has the library do. All of this runs on a worker's thread.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/scene_file.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

/// The object of a scene as it stands on the table; nullptr for the empty table. Fails as the
/// readers do. The same as `turnscan simulate` takes.
Result<std::shared_ptr<const PlacedObject>> load_object(const SceneDescription& scene,
                                                        const RunContext& context);

/// Takes points as they are measured, in the world's frame; called from several threads.
using SampleSink = std::function<void(const std::vector<Vec3f>& points)>;

enum class CoverageColoring { kState, kDensity, kReason };

struct SimulationResult {
  std::string folder;
  CoverageMap map;                      ///< empty where coverage_error is set
  std::optional<Error> coverage_error;  ///< why it is not known what was covered
  std::array<DrawablePtr, 3> colored;   ///< by CoverageColoring; world frame
  Pose T_world_table = Pose::Identity();
  std::string text;
};

/// Records the scene into a folder, with its truth, as `turnscan simulate -o folder --coverage`
/// does, byte for byte. The folder must not exist or be empty; after a failure nothing is left, but
/// a recording that is whole stays: then coverage_error says what became of its coverage.
Result<SimulationResult> simulate(const SceneDescription& scene, const std::string& folder,
                                  const CoverageMapOptions& coverage, const SampleSink& sink,
                                  const RunContext& context);

/// The surface of a hole of the map, a little outside so that it covers the object, and how to look
/// at it. World frame.
struct HoleSurface {
  TriangleMesh mesh;
  Vec3d middle = Vec3d::Zero();  ///< a place on it
  /// Of the directions from which nothing hides that place the nearest to the surface's normal.
  Vec3d from = Vec3d::UnitZ();
};
HoleSurface surface_of_hole(const CoverageMap& map, std::size_t hole, const Pose& T_world_table);

/// Colours of the states and of the reasons, for meshes and legends.
Rgb color_of(CoverageState state);
Rgb color_of(Miss reason);

}  // namespace turnscan::studio
