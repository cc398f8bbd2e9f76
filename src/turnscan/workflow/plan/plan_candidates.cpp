#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/geometry/hull/resting_poses.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/scene/room.hpp>
#include <turnscan/workflow/plan/plan_candidates.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan::workflow {

namespace {

constexpr std::size_t kMaxFurtherPoses = 6;
constexpr double kSamePose_rad = 0.1745;  // 10 deg
constexpr double kMargin_m = 0.02;
constexpr double kFarther_m = 0.5;
constexpr std::size_t kMaxDirections = 48;

/// Tip and lean after which this direction of the mesh points down: the placement leans about Z,
/// then tips about X.
PassEntry laid(const Vec3d& down) {
  const double lean = std::atan2(-down.x(), -down.y());
  const double tip = std::atan2(down.z(), std::hypot(down.x(), down.y()));
  return {{"tip", format_quantity(tip, Quantity::kAngle)},
          {"lean", format_quantity(lean, Quantity::kAngle)}};
}

/// Directions of a mesh, in the frame of its file, that can point down: those of its stable poses,
/// the lowest centre of mass first; else, or if there are few, head and sides.
std::vector<Vec3d> further_downs(const TriangleMesh& first, const Eigen::Matrix3d& to_file) {
  std::vector<Vec3d> downs{-Vec3d::UnitY()};
  const auto add = [&](const Vec3d& down) {
    for (const Vec3d& other : downs)
      if (std::acos(std::clamp(down.dot(other), -1.0, 1.0)) < kSamePose_rad) return;
    if (downs.size() <= kMaxFurtherPoses) downs.push_back(down);
  };
  for (const RestingPose& rest : resting_poses(first)) add(rest.down);
  if (downs.size() < 3)
    for (const Vec3d& prop :
         {Vec3d(0, 1, 0), Vec3d(0, 0, 1), Vec3d(0, 0, -1), Vec3d(1, 0, 0), Vec3d(-1, 0, 0)})
      add(prop);
  downs.erase(downs.begin());
  for (Vec3d& down : downs) down = to_file * down;
  return downs;
}

/// As in a scan: with the body of the platter.
Result<Scene> bench_scene(const TriangleMesh& mesh, const PlatterOptions& platter) {
  std::vector<TriangleMesh> turning{mesh};
  if (platter.visible && platter.thickness_m > 0.0)
    turning.push_back(platter_body(platter.radius_m, platter.thickness_m));
  return Scene::create(turning, platter.visible ? std::optional(platter.radius_m) : std::nullopt);
}

double radius_of(const TriangleMesh& mesh, const Pose& T) {
  double most = 0.0;
  for (const Vec3f& p : mesh.vertices) {
    const Vec3d q = T * p.cast<double>();
    most = std::max(most, std::hypot(q.x(), q.z()));
  }
  return most;
}

Result<PlanObject> load_plan_object(const PlanRequest& request, const std::string& name,
                                    const RunContext& context) {
  SceneDescription scene = request.scene;
  scene.object = name;
  scene.unit = request.unit;
  scene.next_passes.clear();
  PlanObject out;
  TURNSCAN_ASSIGN(out.given, read_object(scene, context));
  TURNSCAN_ASSIGN(const auto first, place_objects(scene, out.given, context));
  if (request.options.passes > 1)
    for (const Vec3d& down :
         further_downs(first.front().mesh, first.front().T_table_object.linear().transpose()))
      scene.next_passes.push_back(laid(down));
  TURNSCAN_ASSIGN(const auto placed, place_objects(scene, out.given, context));
  out.mesh = placed.front().mesh;
  planning::SurfaceSampling sampling;
  sampling.spots = std::size_t(request.options.spots);
  TURNSCAN_ASSIGN(out.surface, planning::sample_plan_surface(out.mesh, sampling, context));
  const Pose T_first = placed.front().T_table_object.inverse();
  for (std::size_t k = 0; k < placed.size(); ++k) {
    TURNSCAN_ASSIGN(Scene bench, bench_scene(placed[k].mesh, scene.platter));
    out.poses.push_back({k == 0 ? PassEntry() : scene.next_passes[k - 1],
                         placed[k].T_table_object * T_first, std::move(bench)});
    out.radius_m = std::max(out.radius_m, radius_of(placed[k].mesh, Pose::Identity()));
  }
  for (const Vec3f& p : out.mesh.vertices) out.height_m = std::max(out.height_m, double(p.y()));
  return out;
}

Result<PlanScanner> load_plan_scanner(const PlanRequest& request, const ScannerEntry& entry) {
  TURNSCAN_ASSIGN(const ScannerSetup setup, scanner_setup(entry, request.scene.placement));
  TURNSCAN_ASSIGN(ScannerModel model, scanner_model(setup.parameters));
  if (model.kind == ScannerKind::kLine)
    return fail(ErrorCode::kInvalidOption,
                "plan: {} is a line scanner, whose travel a plan does not choose; take depth "
                "cameras",
                entry.model);
  for (const auto& [name, value] : entry.options)
    if (name == "distance" || name == "elevation" || name == "azimuth" || name == "aim-height")
      return fail(ErrorCode::kInvalidOption,
                  "scanner {}: the plan chooses its {}; leave it out, or limit it by "
                  "--least-distance, --lowest-elevation and their like",
                  entry.model, name);
  TURNSCAN_ASSIGN(NoiseOptions noise, parse_noise_options(request.scene.measure.noise));
  TURNSCAN_ASSIGN(planning::SigmaSteps sigma, planning::SigmaSteps::create(model, noise));
  return PlanScanner{entry.model, std::move(model), std::move(sigma), entry};
}

Result<> add_places(const PlanRequest& request, PlanField& field) {
  const PlanOptions& o = request.options;
  double aim_m = 0.0, area_m2 = 0.0;
  for (const PlanObject& object : field.objects)
    aim_m += object.surface.area_m2 * 0.5 * object.height_m, area_m2 += object.surface.area_m2;
  const auto step = [](double least, double greatest, int steps, int i) {
    return steps > 1 ? least + (greatest - least) * i / (steps - 1) : 0.5 * (least + greatest);
  };
  field.elevation_step_rad =
      (o.highest_elevation_rad - o.lowest_elevation_rad) / std::max(1, o.elevations - 1);
  for (std::size_t s = 0; s < field.scanners.size(); ++s) {
    TURNSCAN_ASSIGN(const DistanceRange range,
                    distances_of(request, field, field.scanners[s].model));
    TURNSCAN_ASSIGN(const ScannerSetup setup,
                    scanner_setup(field.scanners[s].given, request.scene.placement));
    field.distance_step_m = (range.greatest_m - range.least_m) / std::max(1, o.distances - 1);
    for (int d = 0; d < o.distances; ++d) {
      for (int e = 0; e < o.elevations; ++e) {
        PlanPlace place{s, setup.placement};
        place.placement.distance_m = step(range.least_m, range.greatest_m, o.distances, d);
        place.placement.elevation_rad =
            step(o.lowest_elevation_rad, o.highest_elevation_rad, o.elevations, e);
        place.placement.aim_height_m = aim_m / area_m2;
        field.places.push_back(place);
      }
    }
  }
  return {};
}

Result<> check_plan(const PlanRequest& request) {
  PlanOptions copy = request.options;
  TURNSCAN_TRY(describe(copy).check());
  SceneDescription scene = request.scene;
  for (const SceneTable& table : plan_scene_tables(scene)) TURNSCAN_TRY(table.options.check());
  if (request.objects.empty())
    return fail(ErrorCode::kInvalidOption, "plan: there is no object; name a mesh");
  if (request.scanners.empty())
    return fail(ErrorCode::kInvalidOption, "plan: there is no scanner; name those at hand");
  if (!(copy.lowest_elevation_rad <= copy.highest_elevation_rad))
    return fail(ErrorCode::kInvalidOption, "lowest-elevation = {}: it is above the highest, {}",
                format_quantity(copy.lowest_elevation_rad, Quantity::kAngle),
                format_quantity(copy.highest_elevation_rad, Quantity::kAngle));
  if (copy.time_budget_s && *copy.time_budget_s < copy.turn_time_s)
    return fail(ErrorCode::kInvalidOption, "time-budget = {}: one turn takes {}",
                format_quantity(*copy.time_budget_s, Quantity::kTime),
                format_quantity(copy.turn_time_s, Quantity::kTime));
  return {};
}

}  // namespace

Result<DistanceRange> distances_of(const PlanRequest& request, const PlanField& field,
                                   const ScannerModel& model) {
  double radius = 0.0;
  for (const PlanObject& object : field.objects)
    radius = std::max(radius, std::hypot(object.radius_m, 0.5 * object.height_m));
  const PlanOptions& o = request.options;
  DistanceRange range{};
  range.least_m = o.least_distance_m.value_or(model.near_m + radius + kMargin_m);
  range.greatest_m = o.greatest_distance_m.value_or(
      std::min(std::max(range.least_m, model.far_m), range.least_m + kFarther_m));
  if (range.least_m <= range.greatest_m) return range;
  return fail(ErrorCode::kInvalidOption,
              "least-distance = {}: it is more than the greatest, {}; {} measures from {} on, and "
              "the object's radius is {}",
              format_quantity(range.least_m, Quantity::kLength),
              format_quantity(range.greatest_m, Quantity::kLength), model.name,
              format_quantity(model.near_m, Quantity::kLength),
              format_quantity(radius, Quantity::kLength));
}

Result<PlanField> make_plan_field(const PlanRequest& request, const RunContext& context) {
  TURNSCAN_TRY(check_plan(request));
  PlanField field;
  for (const ScannerEntry& entry : request.scanners) {
    TURNSCAN_ASSIGN(PlanScanner scanner, load_plan_scanner(request, entry));
    field.scanners.push_back(std::move(scanner));
  }
  for (const std::string& name : request.objects) {
    TURNSCAN_ASSIGN(PlanObject object, load_plan_object(request, name, context));
    field.objects.push_back(std::move(object));
  }
  TURNSCAN_ASSIGN(const auto states, platter_states(request.scene.motion));
  for (const PlatterState& state : states) field.angles_rad.push_back(state.angle_rad);
  field.T_world_table = table_pose(request.scene.table);
  TURNSCAN_TRY(add_places(request, field));
  return field;
}

std::vector<planning::SpotSight> sights_from(const PlanField& field, const PlanObject& object,
                                             const PlanPose& pose, const PlanPlace& place) {
  const PlanScanner& scanner = field.scanners[place.scanner];
  const Pose T_world_sensor =
      scanner_pose(place.placement, 0.5 * object.height_m, 0.5, Vec3d::UnitY());
  const auto directions = planning::turn_directions(field.angles_rad, field.T_world_table,
                                                    T_world_sensor, kMaxDirections);
  planning::TurnView view;
  view.model = &scanner.model;
  view.sigma = &scanner.sigma;
  view.scene = &pose.scene;
  view.T_table_surface = pose.T_table_first;
  view.T_table_sensor = directions;
  view.frames_per_direction = double(field.angles_rad.size()) / double(directions.size());
  return planning::turn_sights(object.surface, view);
}

ScannerEntry entry_of(const PlanField& field, const PlanPlace& place) {
  ScannerEntry entry = field.scanners[place.scanner].given;
  const ScannerPlacement& at = place.placement;
  const auto add = [&](const char* name, double value, Quantity quantity) {
    entry.options.emplace_back(name, format_quantity(value, quantity));
  };
  add("distance", at.distance_m, Quantity::kLength);
  add("elevation", at.elevation_rad, Quantity::kAngle);
  if (at.azimuth_rad != 0.0) add("azimuth", at.azimuth_rad, Quantity::kAngle);
  add("aim-height", at.aim_height_m.value_or(0.0), Quantity::kLength);
  return entry;
}

}  // namespace turnscan::workflow
