#include <turnscan/workflow/batch/batch_plan.hpp>
#include <turnscan/workflow/batch/batch_run.hpp>
#include <turnscan/workflow/batch/batch_status.hpp>
#include <turnscan/workflow/batch/run_task.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

class BatchCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional("ACTION", action_,
                    "run: do the tasks that are not done; retry: repeat those that failed; status: "
                    "report progress; task: do one task (called by an engine)");
    line.positionals(
        "PATH...", paths_,
        "run: with --out, a table (.csv, .toml) or folders with recordings; without --out, the "
        "folder of a batch to continue. retry: the folder of the batch, and the tasks to repeat "
        "(default: all that failed). status: the folder of the batch");
    line.option(
        "-o,--out", "FOLDER", out_,
        "run: folder of the batch, created if necessary; tasks that are done in it are kept");
    line.option("--command", "COMMAND", source_.command,
                "run: command for each input, reconstruct or simulate (default: the table's, else "
                "reconstruct)");
    line.repeatable("--set", "NAME=VALUE", source_.set,
                    "run: an option of every task, e.g. method=volumetric; may be given several "
                    "times");
    line.repeatable("--sweep", "NAME=VALUE,...", source_.sweep,
                    "run: repeat every task with each of the values, e.g. voxel-size=1mm,2mm; "
                    "several sweeps give every combination");
    line.flag("--detach", detach_,
              "run, retry: submit the tasks to Slurm and do not wait for them");
    line.allow_config();
    line.group("batch", "Engine", describe(options_));
    line.common({"out", "command", "set", "sweep", "jobs", "engine", "task-threads", "detach",
                 "restarts", "config"});
  }

  FileRoles files() const override {
    FileRoles files{paths_, {}};
    return files;
  }

  Result<> run(Session& session) override {
    session.plan({{"plan", 0.1}, {"look for what is done", 0.1}, {"run tasks", 100.0}});
    if (action_ == "status") return status(session);
    if (action_ == "task") return task(session);
    if (action_ == "run") return run_all(session);
    if (action_ == "retry") return retry(session);
    return fail(ErrorCode::kInvalidOption,
                "ACTION {}: there is no such action; use run, retry, status or task", action_);
  }

 private:
  Result<> status(Session& session) const {
    TURNSCAN_TRY(check_one_path());
    TURNSCAN_ASSIGN(const std::string text, batch_status_text(paths_.front()));
    session.print("{}", text);
    return {};
  }

  Result<> task(Session& session) const {
    const TaskRunSettings settings{own_program(), options_.task_threads.value_or(1)};
    for (std::size_t i = 1; i < paths_.size(); ++i)
      TURNSCAN_TRY(run_task(paths_.front(), paths_[i], settings, session.context()));
    return {};
  }

  Result<> run_all(Session& session) {
    if (out_.empty()) {
      TURNSCAN_TRY(check_one_path());
      if (!source_.set.empty() || !source_.sweep.empty() || !source_.command.empty())
        return fail(ErrorCode::kInvalidOption,
                    "--out: missing; an existing batch keeps its own options, so give inputs and a "
                    "new folder");
      return run_folder(paths_.front(), session);
    }
    source_.inputs = paths_;
    session.context().begin_phase("plan", 0);
    TURNSCAN_ASSIGN(const std::vector<BatchTask> tasks, plan_batch(source_));
    TURNSCAN_TRY(save_batch(out_, tasks));
    return run_folder(out_, session);
  }

  Result<> retry(Session& session) {
    request_.retry_failed = true;
    request_.retry.assign(paths_.begin() + 1, paths_.end());
    return run_folder(paths_.front(), session);
  }

  Result<> check_one_path() const {
    if (paths_.size() == 1) return {};
    return fail(ErrorCode::kInvalidOption,
                "--out: missing; several inputs need a folder for the batch");
  }

  Result<> run_folder(const std::string& folder, Session& session) {
    request_.folder = folder;
    request_.options = options_;
    request_.program = own_program();
    request_.detach = detach_;
    request_.on_status = [&session](const std::string& text) { session.status().set(text); };
    TURNSCAN_ASSIGN(const BatchOutcome outcome, run_batch(request_, session.context()));
    session.print("{} tasks: {} done ({} of them before), {} failed, {} waiting; {:.1f} s\n",
                  outcome.tasks, outcome.done, outcome.skipped, outcome.failed, outcome.waiting,
                  outcome.seconds);
    for (const std::string& file : outcome.files) session.print("Wrote {}\n", file);
    if (outcome.failed == 0) return {};
    return fail(
        ErrorCode::kMissingData,
        "batch: {} of {} tasks failed; see 'turnscan batch status {}', then 'turnscan batch "
        "retry {}'",
        outcome.failed, outcome.tasks, folder, folder);
  }

  std::string action_, out_;
  std::vector<std::string> paths_;
  BatchSource source_;
  BatchRunOptions options_;
  BatchRequest request_;
  bool detach_ = false;
};

}  // namespace

std::unique_ptr<Command> make_batch_command() { return std::make_unique<BatchCommand>(); }

}  // namespace turnscan::cli
