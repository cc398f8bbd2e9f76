#pragma once
// Plans the sensors, their positions and the object's pose in each pass, so that most of its
// surface is measured well enough. docs/reference/plan.md describes the model.
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
  int sensors = 1;                    ///< maximum number
  int passes = 1;                     ///< maximum number
  std::optional<double> max_error_m;  ///< surface with a larger expected error does not count
  std::optional<double> least_distance_m, greatest_distance_m;  ///< nullopt: from the scanner model
  double lowest_elevation_rad = 0.0;
  double highest_elevation_rad = 1.2217304763960306;  ///< 70 deg
  double turn_time_s = 30.0;                          ///< duration of one turn
  double change_time_s = 30.0;          ///< time to reposition the object for the next pass
  std::optional<double> time_budget_s;  ///< for all turns and changes together
  int distances = 4, elevations = 8;    ///< number of candidate steps
  int spots = 2500;                     ///< sample points on the surface of an object
  int plans = 6;                        ///< maximum number of plans written
  int trials = 6;                       ///< maximum number of simulated scans with reconstruction
};

/// Fields sensors, passes, max-error, least-distance, greatest-distance, lowest-elevation,
/// highest-elevation, turn-time, change-time, time-budget, plan-distances, plan-elevations,
/// plan-spots, plans, trials.
OptionTable describe(PlanOptions& options);

/// Tables of those parts of a scene that a plan keeps: objects' placement, turntable, motion,
/// noise.
std::vector<SceneTable> plan_scene_tables(SceneDescription& scene);
/// Default scene: 36 frames, noise from the scanner's formulae.
SceneDescription plan_scene();

/// A simulated scan of a plan, with its reconstruction compared to the ground truth. For several
/// objects the means, weighted by area.
struct PlanTrial {
  double covered = 0.0;         ///< share of the surface, as in the coverage command
  double median_error_m = 0.0;  ///< of the seen surface, mesh to truth; NaN if it failed
  std::string failure;          ///< why there is no mesh; empty: none
};

struct Plan {
  std::vector<ScannerEntry> sensors;                ///< with their complete poses
  std::vector<std::vector<PassEntry>> next_passes;  ///< for each object
  double covered = 0.0;         ///< share of the area seen with an error of at most max_error
  double most_covered = 0.0;    ///< upper bound for all candidate rigs of this size
  double median_error_m = 0.0;  ///< expected error of the covered surface
  double time_s = 0.0;
  bool error_first = false;  ///< optimised for the error rather than the area
  std::optional<PlanTrial> trial;
  std::string unseen;               ///< one sentence: why the rest is not seen
  std::vector<std::string> scenes;  ///< file names, one per object; empty: not written
  std::vector<std::string> pictures;

  std::size_t passes() const;
  std::size_t turns() const { return sensors.size() * passes(); }
};

struct PlanRequest {
  std::vector<std::string> objects;    ///< mesh files or builtin:NAME; at least one
  std::string unit;                    ///< of files that do not state it
  std::vector<ScannerEntry> scanners;  ///< available models; each may be used several times
  SceneDescription scene = plan_scene();
  PlanOptions options;
  /// For output files; empty: none are written, and trials run in this process.
  std::string folder;
  BatchRunOptions engine;         ///< for trials with a folder
  std::filesystem::path program;  ///< the turnscan executable for these
  std::function<void(const std::string&)> on_status{};
};

struct PlanOutcome {
  std::vector<Plan> plans;         ///< Pareto-optimal plans; most covered first
  std::size_t placements = 0;      ///< number of candidates
  std::vector<std::size_t> poses;  ///< per object, including the first pose
  std::uint64_t turns_looked_at = 0;
  std::uint64_t sets_compared = 0;
  std::size_t simulations = 0;  ///< number of trials
  double seconds = 0.0;
  std::string report;  ///< file name; empty without a folder
};

/// Parses texts like "kinect-v2,roll=90deg,realsense-d435": a part with '=' belongs to the scanner
/// before it. Fails with kInvalidOption.
Result<std::vector<ScannerEntry>> parse_plan_scanners(const std::vector<std::string>& texts);

/// Scene of a plan for the object at this index, ready to simulate.
SceneDescription scene_of(const PlanRequest& request, const Plan& plan, std::size_t object);

/// Evaluates every candidate placement in every pose of every object by ray casting, selects for
/// each number of sensors and passes the rigs with the largest coverage (and those with the
/// smallest error), refines their placements, and tries the best with simulated scans. With a
/// folder, writes plan.json, plan-K.toml and plan-K.png there (for several objects plan-K-NAME),
/// and the trials into its subfolder trials/; a run that was killed continues with those.
/// The result is the same, byte for byte, for any number of threads. Fails with kInvalidOption
/// (options; no object, no scanner; a line scanner; ranges that contain no placement),
/// kAlreadyExists for a folder with other content, with kCancelled, and as load_objects(), choose()
/// and run_batch().
Result<PlanOutcome> run_plan(const PlanRequest& request, const RunContext& context);

/// A JSON object of request and outcome; it ends with a line break.
std::string plan_json(const PlanRequest& request, const PlanOutcome& outcome);

/// A ranked table and the sentences, human-readable.
std::string plan_text(const PlanRequest& request, const PlanOutcome& outcome);

}  // namespace turnscan
