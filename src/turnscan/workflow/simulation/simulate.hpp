#pragma once
// A scene recorded by virtual scanners: the recording, its ground truth and the coverage.
// simulate() does everything; its steps are available for callers that observe the frames or
// continue in memory.

#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/run_context.hpp>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/simulator/virtual_passes.hpp>
#include <vector>

namespace turnscan {

/// The scene's object as placed on the platter in each pass; empty for builtin:empty. Fails as
/// read_mesh(), builtin_object() and place_object(); with kInvalidOption for an invalid unit or
/// pass.
Result<std::vector<PlacedObject>> load_objects(const SceneDescription& scene,
                                               const RunContext& context);

/// The scene's object as read or built, and its placements as in load_objects(). Both fail as that
/// does.
Result<TriangleMesh> read_object(const SceneDescription& scene, const RunContext& context);
Result<std::vector<PlacedObject>> place_objects(const SceneDescription& scene,
                                                const TriangleMesh& object,
                                                const RunContext& context);

/// A prepared scene: frames are rendered when they are read.
struct Simulation {
  SceneDescription scene;
  VirtualScanOptions options;        ///< of the first pass
  std::vector<PlacedObject> placed;  ///< see load_objects()
  VirtualPasses scan;
  double prepare_s = 0.0, record_s = 0.0;  ///< wall time
  std::optional<CoverageMap> coverage;     ///< if requested
};

/// The scanners keep in all passes the poses that the first pass gives them. Fails as
/// scan_options(), load_objects() and VirtualScan::create().
Result<Simulation> prepare_simulation(const SceneDescription& scene, const RunContext& context);

/// The same for an object returned by read_object(), whatever object the scene names.
Result<Simulation> prepare_simulation(const SceneDescription& scene, const TriangleMesh& object,
                                      const RunContext& context);

/// Receives every frame as it is recorded, with its position in the scan; called from several
/// threads.
using FrameWatcher = std::function<void(const Frame& frame, std::size_t position)>;

/// Writes the recording and folder/truth (see write_truth()), and with samples also
/// folder/truth/samples (see write_true_samples()). The folder must not exist or be empty; on
/// failure it is removed. Fails as write_recording(), write_truth() and write_true_samples() do.
Result<> record_simulation(const Simulation& simulation, const std::string& folder, bool samples,
                           const FrameWatcher& watcher, const RunContext& context);

/// coverage_of() for a simulation.
Result<CoverageMap> coverage_of(const Simulation& simulation, const CoverageMapOptions& options,
                                const RunContext& context);

struct SimulateRequest {
  SceneDescription scene;
  std::string recording;              ///< folder to create; empty: nothing is recorded
  bool overwrite_unfinished = false;  ///< remove an existing unfinished recording
  bool samples = false;               ///< also write every sample; needs a recording
  std::string coverage;  ///< .ply to write, with a .json of the same name; empty: no coverage
  CoverageMapOptions coverage_options;
  std::string report;  ///< .json report; empty: none
};

/// The .json that accompanies the coverage's .ply.
std::string coverage_json_file(const SimulateRequest& request);

/// Checks whether the outputs can be written. Fails as check_output_folder() and
/// check_output_file(), and with kInvalidOption for samples without a recording.
Result<> check_outputs(const SimulateRequest& request);

/// Clears the output folder, checks the outputs, prepares, records and writes what is requested.
/// Fails as these steps do; a finished recording is kept.
Result<Simulation> simulate(const SimulateRequest& request, const RunContext& context);

/// A JSON report: options, counts, samples by reason, wall times, peak memory; it ends with a line
/// break.
std::string simulation_json(const Simulation& simulation);

}  // namespace turnscan
