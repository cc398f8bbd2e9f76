#include "simulator/simulator_runs.hpp"

#include <algorithm>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/simulation/coverage_file.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan::studio {

namespace {

constexpr std::size_t kShownPerFrame = 3000;

/// Shows a part of each frame's points, in the world's frame.
class FrameSampler {
 public:
  FrameSampler(const VirtualPasses& scan, const Pose& T_world_table, const SampleSink& sink)
      : scan_(scan), T_world_table_(T_world_table), sink_(sink) {
    for (const SensorInfo& sensor : scan.header().sensors) rays_.emplace_back(sensor.intrinsics);
  }

  void operator()(const Frame& frame, std::size_t position) const {
    const std::size_t s = frame.info.sensor;
    const auto points = points_of(frame, scan_.header().sensors.at(s), rays_.at(s));
    if (!points) return;
    const auto [pass, there] = scan_.place_of(position);
    const Pose pose = T_world_table_ * scan_.pass(pass).T_table_sensor(there);
    const auto& all = points->cloud.points;
    const std::size_t step = std::max<std::size_t>(1, all.size() / kShownPerFrame);
    std::vector<Vec3f> shown;
    for (std::size_t i = position % step; i < all.size(); i += step)
      shown.push_back((pose * all[i].cast<double>()).cast<float>());
    sink_(shown);
  }

 private:
  const VirtualPasses& scan_;
  Pose T_world_table_;
  const SampleSink& sink_;
  std::vector<RayTable> rays_;
};

TriangleMesh patch_mesh(const CoverageMap& map, const Pose& pose,
                        const std::function<Rgb(const CoverageCell&)>& color) {
  TriangleMesh mesh;
  for (const CoveragePatch& patch : map.patches) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3f& p : patch.corners)
      mesh.vertices.push_back((pose * p.cast<double>()).cast<float>());
    mesh.colors.insert(mesh.colors.end(), 3, color(map.cells[patch.cell]));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

void color_patches(const CoverageMapOptions& options, SimulationResult& result) {
  const CoverageMap& map = result.map;
  const Pose& pose = result.T_world_table;
  result.colored[0] = make_drawable(
      patch_mesh(map, pose, [](const CoverageCell& cell) { return color_of(cell.state); }),
      Shading::kFlat);
  TriangleMesh density = coverage_mesh(map, options);
  for (Vec3f& p : density.vertices) p = (pose * p.cast<double>()).cast<float>();
  density.normals.clear();
  result.colored[1] = make_drawable(density, Shading::kFlat);
  result.colored[2] = make_drawable(patch_mesh(map, pose,
                                               [](const CoverageCell& cell) {
                                                 return cell.samples > 0 ? color_of(Miss::kNone)
                                                                         : color_of(cell.reason);
                                               }),
                                    Shading::kFlat);
}

}  // namespace

Result<std::shared_ptr<const PlacedObject>> load_object(const SceneDescription& scene,
                                                        const RunContext& context) {
  SceneDescription first = scene;
  first.next_passes.clear();
  TURNSCAN_ASSIGN(std::vector<PlacedObject> placed, load_objects(first, context));
  if (placed.empty()) return std::shared_ptr<const PlacedObject>();
  return std::make_shared<const PlacedObject>(std::move(placed.front()));
}

Result<SimulationResult> simulate(const SceneDescription& scene, const std::string& folder,
                                  const CoverageMapOptions& coverage, const SampleSink& sink,
                                  const RunContext& context) {
  TURNSCAN_TRY(check_output_folder(folder));
  TURNSCAN_ASSIGN(const Simulation simulation, prepare_simulation(scene, context));
  SimulationResult result;
  result.folder = folder;
  result.T_world_table =
      table_pose(scene.table) * simulation.scan.pass(0).T_table_given().inverse();
  FrameWatcher watcher;
  if (sink) watcher = FrameSampler(simulation.scan, result.T_world_table, sink);
  TURNSCAN_TRY(record_simulation(simulation, folder, false, watcher, context));
  if (simulation.placed.empty()) return result;
  auto map = coverage_of(simulation, coverage, context);
  if (!map) {
    result.coverage_error = std::move(map).error();
    return result;
  }
  result.map = std::move(*map);
  result.text = coverage_text(result.map, coverage);
  context.begin_phase("prepare the view", 0);
  color_patches(coverage, result);
  return result;
}

Rgb color_of(CoverageState state) {
  switch (state) {
    case CoverageState::kCovered:
      return {91, 168, 120};
    case CoverageState::kThin:
      return {226, 160, 60};
    case CoverageState::kMissed:
      return {204, 74, 66};
    case CoverageState::kUnreachable:
      break;
  }
  return {140, 146, 152};
}

Rgb color_of(Miss reason) {
  static constexpr std::array<Rgb, std::size_t(kMissCount)> colors{{{188, 200, 208},
                                                                    {110, 110, 110},
                                                                    {124, 92, 170},
                                                                    {160, 130, 200},
                                                                    {90, 140, 200},
                                                                    {226, 122, 63},
                                                                    {204, 74, 66},
                                                                    {226, 190, 70},
                                                                    {80, 70, 60},
                                                                    {200, 110, 160}}};
  return colors[static_cast<std::size_t>(reason)];
}

}  // namespace turnscan::studio
