#include "simulator_runs.hpp"

#include <filesystem>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/builtin_objects.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

#include "coverage_file.hpp"
#include "output_file.hpp"
#include "truth_files.hpp"

namespace turnscan::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::size_t kShownPerFrame = 3000;

/// The scan, every frame of which is also shown.
class Watched : public FrameSequence {
 public:
  Watched(const VirtualPasses& scan, const Pose& T_world_table, const SampleSink& sink)
      : scan_(scan), T_world_table_(T_world_table), sink_(sink) {
    for (const SensorInfo& sensor : scan.header().sensors) rays_.emplace_back(sensor.intrinsics);
  }
  const SequenceHeader& header() const override { return scan_.header(); }
  const std::vector<FrameInfo>& frames() const override { return scan_.frames(); }
  Result<Frame> read(std::size_t position) const override {
    auto frame = scan_.read(position);
    if (frame && sink_) show(*frame, position);
    return frame;
  }

 private:
  void show(const Frame& frame, std::size_t position) const {
    const std::size_t s = frame.info.sensor;
    const auto points = points_of(frame, scan_.header().sensors.at(s), rays_.at(s));
    if (!points) return;
    const Pose pose = T_world_table_ * scan_.pass(0).T_table_sensor(position);
    const auto& all = points->cloud.points;
    const std::size_t step = std::max<std::size_t>(1, all.size() / kShownPerFrame);
    std::vector<Vec3f> shown;
    for (std::size_t i = position % step; i < all.size(); i += step)
      shown.push_back((pose * all[i].cast<double>()).cast<float>());
    sink_(shown);
  }

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

Result<> record(const SceneDescription& scene, const std::vector<PlacedObject>& placed,
                const VirtualPasses& scan, const std::string& folder, const FrameSequence& watched,
                const RunContext& context) {
  std::error_code ignored;
  const bool existed = fs::exists(folder, ignored);
  TURNSCAN_TRY(write_recording(folder, watched, context));
  auto truth = cli::write_truth(folder, scan, scene, placed);
  if (truth || existed) return truth;
  fs::remove_all(folder, ignored);
  return truth;
}

}  // namespace

Result<std::shared_ptr<const PlacedObject>> load_object(const SceneDescription& scene,
                                                        const RunContext& context) {
  if (scene.object == "builtin:empty") return std::shared_ptr<const PlacedObject>();
  context.begin_phase("read object", 0);
  TriangleMesh mesh;
  if (scene.object.starts_with(kBuiltin)) {
    TURNSCAN_ASSIGN(mesh, builtin_object(std::string_view(scene.object).substr(kBuiltin.size())));
  } else {
    ReadMeshOptions options;
    if (!scene.unit.empty()) {
      TURNSCAN_ASSIGN(options.metres_per_unit, metres_per(scene.unit));
    }
    TURNSCAN_ASSIGN(mesh, read_mesh(scene.object, options, context));
    if (mesh.name.empty()) mesh.name = fs::path(scene.object).stem().string();
  }
  auto placed = place_object(std::move(mesh), scene.object_placement);
  if (!placed) {
    Error error = std::move(placed).error();
    error.path = scene.object;
    return tl::unexpected<Error>(std::move(error));
  }
  TURNSCAN_TRY(context.check());
  return std::make_shared<const PlacedObject>(std::move(*placed));
}

Result<SimulationResult> simulate(const SceneDescription& scene, const std::string& folder,
                                  const CoverageMapOptions& coverage, const SampleSink& sink,
                                  const RunContext& context) {
  TURNSCAN_TRY(cli::check_output_folder(folder));
  TURNSCAN_ASSIGN(const VirtualScanOptions options, scan_options(scene));
  TURNSCAN_ASSIGN(const auto placed, load_object(scene, context));
  std::vector<TriangleMesh> meshes;
  if (placed) meshes.push_back(placed->mesh);
  TURNSCAN_ASSIGN(VirtualScan only, VirtualScan::create(std::move(meshes), options));
  std::vector<VirtualScan> one;
  one.push_back(std::move(only));
  const VirtualPasses passes(std::move(one));
  const VirtualScan& scan = passes.pass(0);
  SimulationResult result;
  result.folder = folder;
  result.T_world_table = table_pose(scene.table) * scan.T_table_given().inverse();
  const Watched watched(passes, result.T_world_table, sink);
  std::vector<PlacedObject> objects;
  if (placed) objects.push_back(*placed);
  TURNSCAN_TRY(record(scene, objects, passes, folder, watched, context));
  if (!placed) return result;
  auto map = cli::coverage_of(passes, objects, options, coverage, context);
  if (!map) {
    result.coverage_error = std::move(map).error();
    return result;
  }
  result.map = std::move(*map);
  result.text = cli::coverage_text(result.map, coverage);
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
