#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/plan/plan.hpp>

namespace turnscan {

namespace {

constexpr int kPlanFrames = 36;

/// Parts of a scene that are the same in all plans.
bool kept_by_plans(const std::string& table) {
  return table == "object" || table == "motion" || table == "table" || table == "noise";
}

}  // namespace

OptionTable describe(PlanOptions& o) {
  const Range elevations{-0.125 * kTurn, 0.2475 * kTurn};
  OptionTable table;
  table.number("sensors", o.sensors, {1, 8}, "Largest number of sensors.")
      .number("passes", o.passes, {1, 4},
              "How many passes may be recorded, each with the object laid differently.")
      .number(
          "max-error", o.max_error_m, Quantity::kLength, {1e-6, 1.0},
          "Surface that is expected farther than this from the truth does not count as covered; "
          "auto: whatever is seen counts.")
      .number("least-distance", o.least_distance_m, Quantity::kLength, {0.01, 20.0},
              "Least distance of a sensor from the point that it looks at; auto: the scanner's "
              "near limit and the object's radius.")
      .number("greatest-distance", o.greatest_distance_m, Quantity::kLength, {0.01, 20.0},
              "Greatest distance; auto: half a metre more than the least.")
      .number("lowest-elevation", o.lowest_elevation_rad, Quantity::kAngle, elevations,
              "Lowest elevation of a sensor above the horizontal.")
      .number("highest-elevation", o.highest_elevation_rad, Quantity::kAngle, elevations,
              "Highest elevation.")
      .number("turn-time", o.turn_time_s, Quantity::kTime, {0.1, 1e5},
              "How long one turn takes; all sensors look at the same turn.")
      .number("change-time", o.change_time_s, Quantity::kTime, {0.0, 1e5},
              "How long it takes to lay the object for the next pass.")
      .number("time-budget", o.time_budget_s, Quantity::kTime, {0.1, 1e6},
              "How long all passes may take together; auto: as long as they do.")
      .number("plan-distances", o.distances, {1, 20}, "Steps of distance that are tried.")
      .number("plan-elevations", o.elevations, {1, 40}, "Steps of elevation that are tried.")
      .number("plan-spots", o.spots, {100, 100000},
              "Number of sample points on the surface of an object.")
      .number("plans", o.plans, {1, 50}, "How many plans are written.")
      .number(
          "trials", o.trials, {0, 1000},
          "How many simulated scans with reconstruction try and refine the best plans; 0: none.");
  return table;
}

SceneDescription plan_scene() {
  SceneDescription scene;
  scene.motion.frames = kPlanFrames;
  scene.measure.noise = "model";
  return scene;
}

std::vector<SceneTable> plan_scene_tables(SceneDescription& scene) {
  std::vector<SceneTable> kept;
  for (SceneTable& table : describe(scene))
    if (kept_by_plans(table.name)) kept.push_back(std::move(table));
  return kept;
}

}  // namespace turnscan
