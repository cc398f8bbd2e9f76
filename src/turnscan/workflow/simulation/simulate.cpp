#include <turnscan/core/sequence_views.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/simulation/coverage_file.hpp>
#include <turnscan/workflow/simulation/true_samples.hpp>
#include <turnscan/workflow/simulation/truth_files.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::string_view kEmptyTable = "builtin:empty";

/// The scan, with every frame also passed to the watcher. Both must outlive it.
SequenceView watched(const VirtualPasses& scan, const FrameWatcher& watcher) {
  SequenceView out(scan);
  if (watcher)
    out.set_map([&watcher](Frame frame, std::size_t position) -> Result<Frame> {
      watcher(frame, position);
      return frame;
    });
  return out;
}

Result<VirtualPasses> make_passes(const std::vector<PlacedObject>& placed,
                                  VirtualScanOptions options) {
  std::vector<VirtualScan> scans;
  for (std::size_t k = 0; k < std::max<std::size_t>(placed.size(), 1); ++k) {
    std::vector<TriangleMesh> meshes;
    if (!placed.empty()) meshes.push_back(placed[k].mesh);
    TURNSCAN_ASSIGN(VirtualScan scan, VirtualScan::create(std::move(meshes), options));
    for (VirtualScanner& scanner : options.scanners) {
      if (!scanner.placement.aim_height_m) scanner.placement.aim_height_m = scan.aim_height_m();
      scanner.placement.knock.at_s = 0.0;  // it remains in effect
    }
    // The sensor is warmer when the next pass begins.
    options.measure.warm_up_m *=
        std::exp(-scan.frames().back().time_s / options.measure.warm_up_time_s);
    ++options.record.pass;
    options.first_instant +=
        static_cast<std::uint32_t>(scan.frames().size() / options.scanners.size());
    scans.push_back(std::move(scan));
  }
  return VirtualPasses(std::move(scans));
}

Result<Simulation> ready(const SceneDescription& scene, VirtualScanOptions options,
                         std::vector<PlacedObject> placed,
                         std::chrono::steady_clock::time_point begin) {
  TURNSCAN_ASSIGN(VirtualPasses scan, make_passes(placed, options));
  return Simulation{scene,           std::move(options),   std::move(placed),
                    std::move(scan), seconds_since(begin), 0.0,
                    std::nullopt};
}

/// Removes a recording without ground truth; a folder that existed before is kept.
void discard(const fs::path& folder, bool existed) {
  const auto own = file::Folder::open(folder);
  if (!own) return;
  for (const std::string& name : own->names()) (void)own->remove(name);
  std::error_code ignored;
  if (!existed) fs::remove(folder, ignored);
}

Result<CoverageMap> cover(const Simulation& simulation, const SimulateRequest& request,
                          const RunContext& context) {
  TURNSCAN_ASSIGN(CoverageMap map, coverage_of(simulation, request.coverage_options, context));
  TURNSCAN_TRY(write_coverage_mesh(request.coverage, map, request.coverage_options));
  TURNSCAN_TRY(write_file_atomically(coverage_json_file(request),
                                     coverage_json(map, request.coverage_options)));
  return map;
}

}  // namespace

Result<TriangleMesh> read_object(const SceneDescription& scene, const RunContext& context) {
  if (scene.object.starts_with(kBuiltin))
    return builtin_object(std::string_view(scene.object).substr(kBuiltin.size()), context);
  ReadMeshOptions options;
  if (!scene.unit.empty()) {
    TURNSCAN_ASSIGN(options.metres_per_unit, metres_per(scene.unit));
  }
  TURNSCAN_ASSIGN(TriangleMesh mesh, read_mesh(scene.object, options, context));
  if (mesh.name.empty()) mesh.name = fs::path(scene.object).stem().string();
  return mesh;
}

Result<std::vector<PlacedObject>> place_objects(const SceneDescription& scene,
                                                const TriangleMesh& object,
                                                const RunContext& context) {
  std::vector<PlacedObject> passes;
  TURNSCAN_ASSIGN(const std::vector<ObjectPlacement> placements, pass_placements(scene));
  for (const ObjectPlacement& placement : placements) {
    auto placed = place_object(object, placement);
    if (!placed) {
      Error error = std::move(placed).error();
      error.path = scene.object;
      return tl::unexpected<Error>(std::move(error));
    }
    TURNSCAN_TRY(context.check());
    passes.push_back(std::move(*placed));
  }
  return passes;
}

Result<std::vector<PlacedObject>> load_objects(const SceneDescription& scene,
                                               const RunContext& context) {
  if (scene.object == kEmptyTable) return std::vector<PlacedObject>();
  context.begin_phase("read object", 0);
  TURNSCAN_ASSIGN(const TriangleMesh mesh, read_object(scene, context));
  return place_objects(scene, mesh, context);
}

Result<Simulation> prepare_simulation(const SceneDescription& scene, const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  TURNSCAN_ASSIGN(VirtualScanOptions options, scan_options(scene));
  TURNSCAN_ASSIGN(std::vector<PlacedObject> placed, load_objects(scene, context));
  return ready(scene, std::move(options), std::move(placed), begin);
}

Result<Simulation> prepare_simulation(const SceneDescription& scene, const TriangleMesh& object,
                                      const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  TURNSCAN_ASSIGN(VirtualScanOptions options, scan_options(scene));
  TURNSCAN_ASSIGN(std::vector<PlacedObject> placed, place_objects(scene, object, context));
  return ready(scene, std::move(options), std::move(placed), begin);
}

Result<> record_simulation(const Simulation& simulation, const std::string& folder, bool samples,
                           const FrameWatcher& watcher, const RunContext& context) {
  const VirtualPasses& scan = simulation.scan;
  std::error_code error;
  const bool existed = fs::exists(folder, error);
  TURNSCAN_TRY(write_recording(folder, watched(scan, watcher), context));
  auto truth = write_truth(folder, scan, simulation.scene, simulation.placed);
  if (truth && samples)
    truth = write_true_samples(fs::path(folder) / "truth" / "samples", scan, context);
  if (!truth) discard(folder, existed);
  return truth;
}

Result<CoverageMap> coverage_of(const Simulation& simulation, const CoverageMapOptions& options,
                                const RunContext& context) {
  return coverage_of(simulation.scan, simulation.placed, simulation.options, options, context);
}

std::string coverage_json_file(const SimulateRequest& request) {
  return fs::path(request.coverage).replace_extension(".json").string();
}

Result<> check_outputs(const SimulateRequest& request) {
  if (request.recording.empty() && request.samples)
    return fail(ErrorCode::kInvalidOption, "--samples: they go into a recording; give it --out");
  if (!request.recording.empty())
    TURNSCAN_TRY(check_output_folder(request.recording, request.overwrite_unfinished));
  TURNSCAN_TRY(check_output_file(request.report, ".json"));
  TURNSCAN_TRY(check_output_file(request.coverage, ".ply"));
  if (request.coverage.empty()) return {};
  return check_output_file(coverage_json_file(request), ".json");
}

Result<Simulation> simulate(const SimulateRequest& request, const RunContext& context) {
  TURNSCAN_TRY(check_outputs(request));
  TURNSCAN_ASSIGN(Simulation simulation, prepare_simulation(request.scene, context));
  const auto begin = std::chrono::steady_clock::now();
  if (!request.recording.empty()) {
    TURNSCAN_TRY(clear_output_folder(request.recording, request.overwrite_unfinished));
    TURNSCAN_TRY(record_simulation(simulation, request.recording, request.samples, {}, context));
  }
  simulation.record_s = seconds_since(begin);
  if (!request.coverage.empty()) {
    TURNSCAN_ASSIGN(simulation.coverage, cover(simulation, request, context));
  }
  if (!request.report.empty())
    TURNSCAN_TRY(write_file_atomically(request.report, simulation_json(simulation)));
  return simulation;
}

}  // namespace turnscan
