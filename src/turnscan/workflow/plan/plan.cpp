#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/workflow/plan/plan_files.hpp>
#include <turnscan/workflow/plan/plan_trial.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;
using namespace workflow;

constexpr double kFirstMove = 0.25;  // in candidate steps: how far trials vary the best plan
constexpr std::size_t kMinMoves = 2;

Plan plan_of(const PlanRequest& request, const PlanField& field, const ChosenRig& chosen) {
  Plan plan;
  for (const PlanPlace& place : chosen.rig.places) plan.sensors.push_back(entry_of(field, place));
  for (std::size_t m = 0; m < field.objects.size(); ++m) {
    auto& passes = plan.next_passes.emplace_back();
    for (const std::uint32_t q : chosen.rig.poses[m])
      if (q > 0) passes.push_back(field.objects[m].poses[q].entry);
  }
  plan.covered = chosen.score.covered;
  plan.most_covered = std::max(chosen.most_covered, chosen.score.covered);
  plan.median_error_m = chosen.score.median_error_m;
  plan.error_first = chosen.error_first;
  const auto passes = double(chosen.passes);
  plan.time_s =
      passes * request.options.turn_time_s + (passes - 1.0) * request.options.change_time_s;
  return plan;
}

/// The plans under construction: rigs, and the results for each.
class PlanRun {
 public:
  PlanRun(const PlanRequest& request, const PlanField& field, const RunContext& context)
      : request_(request),
        field_(field),
        context_(context),
        search_(request, field),
        runner_(request) {}

  Result<PlanOutcome> run() {
    TURNSCAN_TRY(search_.look(context_));
    TURNSCAN_ASSIGN(rigs_, search_.choose_all(context_));
    take_simplest();
    context_.begin_phase("refine", rigs_.size());
    for (ChosenRig& rig : rigs_) {
      TURNSCAN_ASSIGN(rig, search_.refined(rig, context_));
      context_.advance();
    }
    rigs_ = unbeaten(rigs_);
    trials_.resize(rigs_.size());
    TURNSCAN_TRY(try_plans());
    TURNSCAN_TRY(vary_best());
    return outcome();
  }

 private:
  /// Takes as many as requested: those optimised for area come first, and among these the ones with
  /// the fewest turns.
  void take_simplest() {
    std::stable_sort(rigs_.begin(), rigs_.end(), [](const ChosenRig& a, const ChosenRig& b) {
      if (a.error_first != b.error_first) return b.error_first;
      return a.rig.places.size() * a.passes < b.rig.places.size() * b.passes;
    });
    rigs_.resize(std::min(rigs_.size(), std::size_t(request_.options.plans)));
  }

  /// Number of simulated scans that a trial of a plan takes.
  std::size_t each() const { return field_.objects.size(); }
  std::size_t left() const {
    const auto all = std::size_t(request_.options.trials);
    return all > simulations_ ? (all - simulations_) / each() : 0;
  }

  Result<std::vector<PlanTrial>> tried(const std::vector<ChosenRig>& rigs,
                                       const std::string& round) {
    std::vector<TrialScene> scenes;
    for (std::size_t k = 0; k < rigs.size(); ++k) {
      const Plan plan = plan_of(request_, field_, rigs[k]);
      for (std::size_t m = 0; m < each(); ++m)
        scenes.push_back({fmt::format("{}-{}-{}", round, k + 1, m + 1), scene_of(request_, plan, m),
                          &field_.objects[m].given});
    }
    simulations_ += scenes.size();
    TURNSCAN_ASSIGN(const std::vector<PlanTrial> single, runner_.run(scenes, context_));
    std::vector<PlanTrial> out;
    for (std::size_t k = 0; k < rigs.size(); ++k) {
      PlanTrial& mean = out.emplace_back();
      double area = 0.0;
      for (std::size_t m = 0; m < each(); ++m) {
        const PlanTrial& one = single[k * each() + m];
        const double a = field_.objects[m].surface.area_m2;
        mean.covered += a * one.covered, mean.median_error_m += a * one.median_error_m, area += a;
        if (mean.failure.empty()) mean.failure = one.failure;
      }
      mean.covered /= area, mean.median_error_m /= area;
    }
    return out;
  }

  Result<> try_plans() {
    const std::size_t n = std::min(rigs_.size(), left());
    if (n == 0) return {};
    const std::vector<ChosenRig> first(rigs_.begin(), rigs_.begin() + std::ptrdiff_t(n));
    TURNSCAN_ASSIGN(const auto trials, tried(first, "plan"));
    for (std::size_t k = 0; k < n; ++k) trials_[k] = trials[k];
    // Plans without a mesh come last.
    std::vector<std::size_t> order(rigs_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_partition(order.begin(), order.end(), [&](std::size_t k) {
      return !trials_[k] || trials_[k]->failure.empty();
    });
    const auto rigs = rigs_;
    const auto old = trials_;
    for (std::size_t k = 0; k < order.size(); ++k)
      rigs_[k] = rigs[order[k]], trials_[k] = old[order[k]];
    return {};
  }

  double worth(const PlanTrial& trial, bool error_first) const {
    if (!trial.failure.empty() || !(trial.median_error_m >= 0.0)) return 0.0;
    const Prefer prefer = error_first ? Prefer::kError : Prefer::kCovered;
    return trial.covered * double(worth_of(trial.median_error_m, std::nullopt, prefer));
  }

  /// Spends the remaining trials on the best plan, with its sensors a little closer, farther,
  /// higher and lower.
  Result<> vary_best() {
    const std::size_t n = std::min<std::size_t>(left(), 4 * rigs_.front().rig.places.size());
    if (n < kMinMoves || !trials_.front()) return {};
    std::vector<ChosenRig> moved;
    for (std::size_t i = 0; i < n; ++i) {
      ChosenRig& rig = moved.emplace_back(rigs_.front());
      PlanPlace& place = rig.rig.places[i / 4];
      const double sign = i % 2 == 0 ? kFirstMove : -kFirstMove;
      TURNSCAN_ASSIGN(const DistanceRange range,
                      distances_of(request_, field_, field_.scanners[place.scanner].model));
      ScannerPlacement& at = place.placement;
      if (i % 4 < 2)
        at.elevation_rad = std::clamp(at.elevation_rad + sign * field_.elevation_step_rad,
                                      request_.options.lowest_elevation_rad,
                                      request_.options.highest_elevation_rad);
      else
        at.distance_m = std::clamp(at.distance_m + sign * field_.distance_step_m, range.least_m,
                                   range.greatest_m);
      rig.score = search_.score(rig.rig, rig.error_first ? Prefer::kError : Prefer::kCovered);
    }
    TURNSCAN_ASSIGN(const auto trials, tried(moved, "varied"));
    const bool error_first = rigs_.front().error_first;
    for (std::size_t i = 0; i < n; ++i)
      if (worth(trials[i], error_first) > worth(*trials_.front(), error_first))
        rigs_.front() = moved[i], trials_.front() = trials[i];
    return {};
  }

  Result<PlanOutcome> outcome() {
    PlanOutcome out;
    for (std::size_t k = 0; k < rigs_.size(); ++k) {
      Plan plan = plan_of(request_, field_, rigs_[k]);
      plan.trial = trials_[k];
      out.plans.push_back(std::move(plan));
    }
    context_.begin_phase("reasons", out.plans.size());
    for (std::size_t k = 0; k < out.plans.size(); ++k) {
      TURNSCAN_TRY(explain(out.plans[k], rigs_[k], k + 1));
      context_.advance();
    }
    out.placements = field_.places.size();
    for (const PlanObject& object : field_.objects) out.poses.push_back(object.poses.size());
    out.turns_looked_at = search_.turns();
    out.sets_compared = search_.sets();
    out.simulations = simulations_;
    return out;
  }

  Result<> explain(Plan& plan, const ChosenRig& rig, std::size_t rank) const {
    for (std::size_t m = 0; m < each(); ++m) {
      const SceneDescription scene = scene_of(request_, plan, m);
      TURNSCAN_ASSIGN(const Simulation simulation,
                      prepare_simulation(scene, field_.objects[m].given, RunContext()));
      TURNSCAN_TRY(context_.check());
      TURNSCAN_ASSIGN(const CoverageMap map, coverage_of(simulation, {}, RunContext()));
      TURNSCAN_TRY(context_.check());
      plan.unseen += each() > 1 ? fmt::format("{}{}: ", m > 0 ? " " : "", request_.objects[m]) : "";
      plan.unseen += unseen_sentence(map);
      if (request_.folder.empty()) continue;
      const fs::path base = fs::path(request_.folder) / plan_file_name(request_, rank, m);
      plan.scenes.push_back(base.string() + ".toml");
      plan.pictures.push_back(base.string() + ".png");
      TURNSCAN_TRY(write_file_atomically(plan.scenes.back(), scene_toml(scene)));
      TURNSCAN_ASSIGN(const ColorImage picture,
                      plan_picture(field_, m, rig.rig, request_.options.max_error_m, RunContext()));
      TURNSCAN_TRY(write_color_png(plan.pictures.back(), picture));
    }
    return {};
  }

  const PlanRequest& request_;
  const PlanField& field_;
  const RunContext& context_;
  PlanSearch search_;
  TrialRunner runner_;
  std::vector<ChosenRig> rigs_;
  std::vector<std::optional<PlanTrial>> trials_;
  std::size_t simulations_ = 0;
};

/// Removes the plans of an earlier run, which may have been more.
void remove_earlier(const std::string& folder) {
  const auto own = file::Folder::open(folder);
  if (!own) return;
  for (const std::string& name : own->names())
    if (is_plan_file(name)) (void)own->remove(name);
}

}  // namespace

std::size_t Plan::passes() const {
  return 1 + (next_passes.empty() ? 0 : next_passes.front().size());
}

Result<std::vector<ScannerEntry>> parse_plan_scanners(const std::vector<std::string>& texts) {
  std::vector<ScannerEntry> out;
  for (const std::string& text : texts) {
    std::string one;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const std::string part = text.substr(begin, end - begin);
      if (!one.empty() && part.find('=') == std::string::npos) {
        TURNSCAN_ASSIGN(ScannerEntry entry, parse_scanner_entry(one));
        out.push_back(std::move(entry));
        one.clear();
      }
      one += (one.empty() ? "" : ",") + part;
      begin = end + 1;
    }
    TURNSCAN_ASSIGN(ScannerEntry entry, parse_scanner_entry(one));
    out.push_back(std::move(entry));
  }
  return out;
}

SceneDescription scene_of(const PlanRequest& request, const Plan& plan, std::size_t object) {
  SceneDescription scene = request.scene;
  scene.object = request.objects[object];
  scene.unit = request.unit;
  scene.scanners = plan.sensors;
  scene.next_passes = plan.next_passes[object];
  return scene;
}

Result<PlanOutcome> run_plan(const PlanRequest& request, const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  if (!request.folder.empty()) TURNSCAN_TRY(check_plan_folder(request.folder));
  TURNSCAN_ASSIGN(const PlanField field, make_plan_field(request, context));
  std::error_code error;
  if (!request.folder.empty()) {
    fs::create_directories(request.folder, error);
    if (error)
      return fail_at(request.folder, ErrorCode::kIo, "the folder cannot be made: {}",
                     error.message());
    remove_earlier(request.folder);
  }
  PlanRun run(request, field, context);
  TURNSCAN_ASSIGN(PlanOutcome outcome, run.run());
  outcome.seconds = seconds_since(begin);
  if (request.folder.empty()) return outcome;
  outcome.report = (fs::path(request.folder) / "plan.json").string();
  TURNSCAN_TRY(write_file_atomically(outcome.report, plan_json(request, outcome)));
  return outcome;
}

}  // namespace turnscan
