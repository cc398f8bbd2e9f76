#pragma once
// Where to put which sensors, and how to lay the object for which passes, so that most of its
// surface is measured well enough. docs/plan.md has the model.
//
//   PlanRequest request;
//   request.objects = {"vase.ply"};
//   TURNSCAN_ASSIGN(const PlanOutcome outcome, run_plan(request, context));

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/workflow/batch/batch_run.hpp>
#include <vector>

namespace turnscan {

struct PlanOptions {
  int sensors = 1;                    ///< at most
  int passes = 1;                     ///< at most
  std::optional<double> max_error_m;  ///< what is expected farther from the truth does not count
  std::optional<double> least_distance_m, greatest_distance_m;  ///< nullopt: from the scanner
  double lowest_elevation_rad = 0.0;
  double highest_elevation_rad = 1.2217304763960306;  ///< 70 deg
  double turn_time_s = 30.0;                          ///< that one turn takes
  double change_time_s = 30.0;                        ///< to lay the object for the next pass
  std::optional<double> time_budget_s;                ///< of all turns and changes together
  int distances = 4, elevations = 8;                  ///< steps of the candidates
  int spots = 2500;                                   ///< that stand for the surface of an object
  int plans = 6;                                      ///< written, at most
  int trials = 6;  ///< simulated scans with reconstruction, at most
};

/// Fields sensors, passes, max-error, least-distance, greatest-distance, lowest-elevation,
/// highest-elevation, turn-time, change-time, time-budget, plan-distances, plan-elevations,
/// plan-spots, plans, trials.
OptionTable describe(PlanOptions& options);

/// A table of what of a scene a plan keeps: objects' placement, turntable, motion, noise.
std::vector<SceneTable> plan_scene_tables(SceneDescription& scene);
/// 36 frames, the noise of the scanner's formulae.
SceneDescription plan_scene();

/// A simulated scan of a plan and its reconstruction against the truth. Of several objects the
/// means, weighted by area.
struct PlanTrial {
  double covered = 0.0;         ///< share of the surface, as of the coverage command
  double median_error_m = 0.0;  ///< of what was seen, mesh to truth; NaN where failed
  std::string failure;          ///< why there is no mesh; empty: none
};

struct Plan {
  std::vector<ScannerEntry> sensors;                ///< with their whole place
  std::vector<std::vector<PassEntry>> next_passes;  ///< of each object
  double covered = 0.0;         ///< share of the area seen with an error of max_error at most
  double most_covered = 0.0;    ///< no rig of the candidates of this size covers more
  double median_error_m = 0.0;  ///< expected, of what is covered
  double time_s = 0.0;
  bool error_first = false;  ///< chosen for the error rather than the area
  std::optional<PlanTrial> trial;
  std::string unseen;               ///< a sentence: why the rest is not seen
  std::vector<std::string> scenes;  ///< files, one an object; empty: not written
  std::vector<std::string> pictures;

  std::size_t passes() const;
  std::size_t turns() const { return sensors.size() * passes(); }
};

struct PlanRequest {
  std::vector<std::string> objects;    ///< mesh files or builtin:NAME; at least one
  std::string unit;                    ///< of files that do not say it
  std::vector<ScannerEntry> scanners;  ///< at hand; each may be used several times
  SceneDescription scene = plan_scene();
  PlanOptions options;
  std::string folder;      ///< for files; empty: none are written, and trials run in this process
  BatchRunOptions engine;  ///< of trials with a folder
  std::filesystem::path program;  ///< turnscan, for these
  std::function<void(const std::string&)> on_status{};
};

struct PlanOutcome {
  std::vector<Plan> plans;     ///< none is as good as another in all respects; most covered first
  std::size_t placements = 0;  ///< candidates
  std::vector<std::size_t> poses;  ///< of each object, the first included
  std::uint64_t turns_looked_at = 0;
  std::uint64_t sets_compared = 0;
  std::size_t simulations = 0;  ///< trials
  double seconds = 0.0;
  std::string report;  ///< file; empty without a folder
};

/// Texts like "kinect-v2,roll=90deg,realsense-d435": a part with '=' belongs to the scanner before
/// it. Fails with kInvalidOption.
Result<std::vector<ScannerEntry>> parse_plan_scanners(const std::vector<std::string>& texts);

/// A scene of a plan, ready for simulate; of the object at this position.
SceneDescription scene_of(const PlanRequest& request, const Plan& plan, std::size_t object);

/// Looks at every candidate placement in every pose of every object with rays, chooses for each
/// number of sensors and passes allowed those that cover most (and those that err least), refines
/// their places, and tries the best with simulated scans. With a folder, writes plan.json,
/// plan-K.toml and plan-K.png there (of several objects plan-K-NAME), and the trials into the
/// folder's trials/; a run that was killed goes on with those.
/// The same bytes for every number of threads. Fails with kInvalidOption (options; no object, no
/// scanner; a line scanner; ranges that hold no place), kAlreadyExists for a folder with other
/// content, with kCancelled, and as load_objects(), choose() and run_batch().
Result<PlanOutcome> run_plan(const PlanRequest& request, const RunContext& context);

/// A JSON object of request and outcome; it ends with a line break.
std::string plan_json(const PlanRequest& request, const PlanOutcome& outcome);

/// A ranked table and the sentences, for people.
std::string plan_text(const PlanRequest& request, const PlanOutcome& outcome);

}  // namespace turnscan
