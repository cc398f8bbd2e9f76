#pragma once
// Tasks of the Simulator that use the library. All of this runs on a worker thread.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/scene_file.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

/// The object of a scene as placed on the table, the same as for `turnscan simulate`; nullptr for
/// the empty table. Fails as the readers do.
Result<std::shared_ptr<const PlacedObject>> load_object(const SceneDescription& scene,
                                                        const RunContext& context);

/// Receives points as they are measured, in the world frame; called from several threads.
using SampleSink = std::function<void(const std::vector<Vec3f>& points)>;

enum class CoverageColoring { kState, kDensity, kReason };

struct SimulationResult {
  std::string folder;
  CoverageMap map;                      ///< empty if coverage_error is set
  std::optional<Error> coverage_error;  ///< why the coverage is not known
  std::array<DrawablePtr, 3> colored;   ///< indexed by CoverageColoring; world frame
  Pose T_world_table = Pose::Identity();
  std::string text;
};

/// Records the scene into a folder, with its ground truth, as `turnscan simulate -o folder
/// --coverage` does, byte for byte. The folder must not exist or be empty; it is removed on
/// failure, except that a complete recording is kept: then coverage_error says why there is no
/// coverage.
Result<SimulationResult> simulate(const SceneDescription& scene, const std::string& folder,
                                  const CoverageMapOptions& coverage, const SampleSink& sink,
                                  const RunContext& context);

/// The surface of a hole in the map, slightly offset outward so that it covers the object, and how
/// to view it. World frame.
struct HoleSurface {
  TriangleMesh mesh;
  Vec3d middle = Vec3d::Zero();  ///< a point on it
  /// The direction closest to the surface's normal among those from which the point is not
  /// occluded.
  Vec3d from = Vec3d::UnitZ();
};
HoleSurface surface_of_hole(const CoverageMap& map, std::size_t hole, const Pose& T_world_table);

/// Colours of the states and of the reasons, for meshes and legends.
Rgb color_of(CoverageState state);
Rgb color_of(Miss reason);

}  // namespace turnscan::studio
