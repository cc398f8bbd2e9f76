#include "simulator/simulator_runs.hpp"

#include <algorithm>
#include <cmath>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/simulation/coverage_file.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan::studio {

namespace {

constexpr std::size_t kShownPerFrame = 3000;

/// Shows a subset of each frame's points, in the world frame.
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

namespace {

/// Whether a ray hits a triangle, beyond a minimum distance that excludes the surface on which it
/// starts (Moeller and Trumbore 1997).
bool meets(const Vec3d& origin, const Vec3d& direction, const std::array<Vec3f, 3>& corners) {
  constexpr double kClear_m = 1e-3;
  const Vec3d a = corners[0].cast<double>(), ab = corners[1].cast<double>() - a,
              ac = corners[2].cast<double>() - a;
  const Vec3d p = direction.cross(ac);
  const double det = ab.dot(p);
  if (std::abs(det) < 1e-18) return false;
  const Vec3d s = origin - a;
  const double u = s.dot(p) / det;
  if (u < 0.0 || u > 1.0) return false;
  const Vec3d q = s.cross(ab);
  const double v = direction.dot(q) / det;
  return v >= 0.0 && u + v <= 1.0 && ac.dot(q) / det > kClear_m;
}

/// The normal, and directions around it at increasing angles.
std::vector<Vec3d> directions_about(const Vec3d& normal) {
  std::vector<Vec3d> out{normal};
  const Vec3d side = normal.unitOrthogonal();
  constexpr int kAround = 12;
  for (const double tilt_deg : {15.0, 30.0, 45.0, 60.0, 75.0})
    for (int i = 0; i < kAround; ++i) {
      const Vec3d axis = Eigen::AngleAxisd(2.0 * EIGEN_PI * i / kAround, normal) * side;
      out.push_back(Eigen::AngleAxisd(tilt_deg * EIGEN_PI / 180.0, axis) * normal);
    }
  return out;
}

/// Table frame.
Vec3d free_direction(const CoverageMap& map, const Vec3d& at, const Vec3d& normal) {
  for (const Vec3d& direction : directions_about(normal)) {
    const bool hidden =
        std::any_of(map.patches.begin(), map.patches.end(),
                    [&](const CoveragePatch& p) { return meets(at, direction, p.corners); });
    if (!hidden) return direction;
  }
  return normal;
}

}  // namespace

HoleSurface surface_of_hole(const CoverageMap& map, std::size_t hole, const Pose& T_world_table) {
  constexpr float kOutside_m = 0.0003f;
  HoleSurface out;
  const Vec3d center = map.holes.at(hole).center;
  Vec3d middle = center, normal = Vec3d::UnitZ();
  double nearest = 1e300;
  for (const CoveragePatch& patch : map.patches) {
    if (map.cells[patch.cell].hole != hole) continue;
    const auto& [a, b, c] = patch.corners;
    const Vec3f doubled = (b - a).cross(c - a);
    if (!(doubled.norm() > 0.0f)) continue;
    const Vec3f unit = doubled.normalized();
    const auto first = static_cast<std::uint32_t>(out.mesh.vertices.size());
    for (const Vec3f& p : patch.corners)
      out.mesh.vertices.push_back(
          (T_world_table * (p + kOutside_m * unit).cast<double>()).cast<float>());
    out.mesh.triangles.push_back({first, first + 1, first + 2});
    const Vec3d at = ((a + b + c) / 3.0f).cast<double>();
    if ((at - center).squaredNorm() >= nearest) continue;
    nearest = (at - center).squaredNorm();
    middle = at;
    normal = unit.cast<double>();
  }
  out.middle = T_world_table * middle;
  out.from = T_world_table.linear() * free_direction(map, middle, normal);
  return out;
}

Rgb color_of(CoverageState state) {
  // Colours of M. Okabe and K. Ito, "Color universal design" (2008): distinguishable by everyone.
  switch (state) {
    case CoverageState::kCovered:
      return {86, 180, 233};
    case CoverageState::kThin:
      return {240, 228, 66};
    case CoverageState::kMissed:
      return {213, 94, 0};
    case CoverageState::kUnreachable:
      break;
  }
  return {90, 94, 100};
}

Rgb color_of(Miss reason) {
  static constexpr std::array<Rgb, std::size_t(kMissCount)> colors{{{196, 204, 210},
                                                                    {110, 112, 116},
                                                                    {0, 75, 135},
                                                                    {86, 180, 233},
                                                                    {0, 158, 115},
                                                                    {230, 159, 0},
                                                                    {213, 94, 0},
                                                                    {240, 228, 66},
                                                                    {40, 36, 32},
                                                                    {204, 121, 167}}};
  return colors[static_cast<std::size_t>(reason)];
}

}  // namespace turnscan::studio
