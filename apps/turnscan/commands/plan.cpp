#include <algorithm>
#include <filesystem>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/workflow/plan/plan.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

class PlanCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positionals("MESH...", request_.objects,
                     fmt::format("Objects to be scanned, or similar ones: mesh files or {}",
                                 "builtin:NAME, as in simulate"));
    line.required_repeatable(
        "--scanner", "SCANNER,...", scanners_,
        fmt::format(
            "Available sensors: presets ({}) or files FILE.toml; the rig may have several of each. "
            "Fixed parts of its placement and "
            "keys of its file follow after commas: kinect-v2,roll=90deg",
            fmt::join(scanner_presets(), ", ")));
    line.required_option("-o,--out", "FOLDER", request_.folder,
                         "Folder for the plans, created if necessary; plans of an earlier run in "
                         "it are replaced, and its trials are reused");
    line.option("--unit", "UNIT", request_.unit,
                "Unit of MESH if its file does not say it: mm, m, ...");
    line.allow_config();
    line.group("plan", "Plan", describe(request_.options));
    for (SceneTable& table : plan_scene_tables(request_.scene))
      line.group(table.name, table.title, std::move(table.options));
    line.group("batch", "Engine of the trials", describe(request_.engine));
    line.common({"scanner", "out", "sensors", "passes", "time-budget", "max-error", "plans",
                 "trials", "least-distance", "greatest-distance", "height", "jobs"});
  }

  FileRoles files() const override {
    FileRoles files{request_.objects, {}};
    const std::filesystem::path folder = request_.folder;
    files.outputs.push_back((folder / "plan.json").string());
    for (const std::string& text : scanners_)
      files.inputs.push_back(text.substr(0, text.find(',')));
    return files;
  }

  Result<> run(Session& session) override {
    TURNSCAN_ASSIGN(request_.scanners, parse_plan_scanners(scanners_));
    request_.program = own_program();
    session.plan(phases());
    request_.on_status = [&session](const std::string& text) { session.status().set(text); };
    TURNSCAN_ASSIGN(const PlanOutcome outcome, run_plan(request_, session.context()));
    session.print("{}", plan_text(request_, outcome));
    session.print(
        "\n{} placements, {} turns looked at, {} sets compared, {} simulated scans; {:.1f} s\n",
        outcome.placements, outcome.turns_looked_at, outcome.sets_compared, outcome.simulations,
        outcome.seconds);
    for (const Plan& plan : outcome.plans)
      for (const std::string& scene : plan.scenes) session.print("Wrote {}\n", scene);
    session.print("Wrote {}\n", outcome.report);
    return {};
  }

 private:
  PhasePlan phases() const {
    PhasePlan plan{{"surface", 1.0}, {"candidates", 20.0}, {"choose", 5.0}, {"refine", 3.0}};
    // The remaining trials vary the best plan.
    const int trials = request_.options.trials, first = std::min(trials, request_.options.plans);
    for (const int tasks : {first, trials - first})
      if (tasks > 0)
        plan = joined({plan, {{"look for what is done", 0.1}, {"run tasks", 10.0 * tasks}}});
    plan.push_back({"reasons", 1.0});
    return plan;
  }

  std::vector<std::string> scanners_;
  PlanRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_plan_command() { return std::make_unique<PlanCommand>(); }

}  // namespace turnscan::cli
