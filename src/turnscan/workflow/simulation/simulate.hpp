#pragma once
// A scene recorded by virtual scanners: the recording, the truth beside it, what was covered.
// simulate() does all of it; its steps are there for whoever wants to watch or to go on in memory.

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

/// The scene's object as it lies on the platter in each pass; none for builtin:empty. Fails as
/// read_mesh(), builtin_object() and place_object(); with kInvalidOption for a unit or a pass that
/// is wrong.
Result<std::vector<PlacedObject>> load_objects(const SceneDescription& scene,
                                               const RunContext& context);

/// The scene's object as its file or its builder has it, and that mesh as load_objects() places it.
/// Fail as that does.
Result<TriangleMesh> read_object(const SceneDescription& scene, const RunContext& context);
Result<std::vector<PlacedObject>> place_objects(const SceneDescription& scene,
                                                const TriangleMesh& object,
                                                const RunContext& context);

/// A scene made ready: frames are rendered when they are read.
struct Simulation {
  SceneDescription scene;
  VirtualScanOptions options;        ///< of the first pass
  std::vector<PlacedObject> placed;  ///< see load_objects()
  VirtualPasses scan;
  double prepare_s = 0.0, record_s = 0.0;  ///< wall time
  std::optional<CoverageMap> coverage;     ///< where it was asked for
};

/// The scanners keep their places in all passes: what the first pass makes them look at. Fails as
/// scan_options(), load_objects() and VirtualScan::create().
Result<Simulation> prepare_simulation(const SceneDescription& scene, const RunContext& context);

/// The same for an object that read_object() gave, whatever the scene names.
Result<Simulation> prepare_simulation(const SceneDescription& scene, const TriangleMesh& object,
                                      const RunContext& context);

/// Gets every frame as it is recorded, with its position in the scan; called from several threads.
using FrameWatcher = std::function<void(const Frame& frame, std::size_t position)>;

/// Writes the recording and folder/truth (see write_truth()), with samples also
/// folder/truth/samples (see write_true_samples()). The folder must not exist or be empty; on
/// failure nothing of it remains. Fails as write_recording(), write_truth() and
/// write_true_samples() do.
Result<> record_simulation(const Simulation& simulation, const std::string& folder, bool samples,
                           const FrameWatcher& watcher, const RunContext& context);

/// coverage_of() for a simulation.
Result<CoverageMap> coverage_of(const Simulation& simulation, const CoverageMapOptions& options,
                                const RunContext& context);

struct SimulateRequest {
  SceneDescription scene;
  std::string recording;              ///< folder to make; empty: nothing is recorded
  bool overwrite_unfinished = false;  ///< an unfinished recording there is removed
  bool samples = false;               ///< also write every sample; needs a recording
  std::string coverage;               ///< .ply to write, and beside it a .json; empty: no coverage
  CoverageMapOptions coverage_options;
  std::string report;  ///< .json of what was done; empty: none
};

/// The .json beside the coverage's .ply.
std::string coverage_json_file(const SimulateRequest& request);

/// Whether the outputs can be written. Fails as check_output_folder() and check_output_file(), and
/// with kInvalidOption for samples without a recording.
Result<> check_outputs(const SimulateRequest& request);

/// Makes room, checks the outputs, prepares, records and writes what is asked for. Fails as these
/// steps do; a recording that was finished stays.
Result<Simulation> simulate(const SimulateRequest& request, const RunContext& context);

/// A JSON object of what was done: options, counts, samples by reason, wall times, peak memory; it
/// ends with a line break.
std::string simulation_json(const Simulation& simulation);

}  // namespace turnscan
