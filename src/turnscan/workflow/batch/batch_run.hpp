#pragma once
// Runs a batch, from its folder to its summary, on an engine.
//
//   TURNSCAN_ASSIGN(const auto tasks, plan_batch({{"scans"}, {}, {}, {}}));
//   TURNSCAN_TRY(save_batch("results", tasks));
//   TURNSCAN_ASSIGN(const BatchOutcome outcome, run_batch(request, context));

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <vector>

namespace turnscan {

enum class BatchEngine { kLocal, kSlurm };

struct BatchRunOptions {
  BatchEngine engine = BatchEngine::kLocal;
  std::string engine_options;  ///< for sbatch
  std::optional<int> jobs;  ///< concurrent local jobs; nullopt: as many as cores and memory allow
  std::optional<int> task_threads;  ///< nullopt: 1, or more if there are fewer tasks than cores
  int tasks_per_job = 1;            ///< Slurm: number of tasks that one array element runs
  int restarts = 2;                 ///< of a task whose process or node was lost
};

OptionTable describe(BatchRunOptions& options);

struct BatchRequest {
  std::string folder;
  BatchRunOptions options;
  std::filesystem::path program;   ///< the turnscan executable that runs each task
  bool retry_failed = false;       ///< run failed tasks again
  std::vector<std::string> retry;  ///< only these, done or not; empty: all that failed
  bool detach = false;             ///< Slurm: submit the tasks and do not wait for them
  /// Called on every change, e.g. with "12 of 200 done, 1 failed; 2 running".
  std::function<void(const std::string&)> on_status;
};

struct BatchOutcome {
  std::size_t tasks = 0, done = 0, failed = 0, waiting = 0;
  std::size_t skipped = 0;  ///< of the done tasks, those that were done before this run
  double seconds = 0.0;
  std::vector<std::string> files;  ///< of the summary
};

/// Path of the running executable.
std::filesystem::path own_program();

/// Creates the folder of a batch, or replaces the tasks of an existing one; results of unchanged
/// tasks are kept. Fails with kAlreadyExists in a folder with other content or while a run is in
/// progress in it, and with kIo.
Result<> save_batch(const std::string& folder, const std::vector<BatchTask>& tasks);

/// Runs all tasks that are not done, waits for them, and writes summary.csv, .json and .html.
/// Failed tasks are skipped unless they changed or are to be retried; a failure does not stop other
/// tasks. Tasks that an earlier, killed run submitted to Slurm are waited for, not submitted again.
/// Fails with kAlreadyExists while another run is in progress in the folder, with kNotFound if
/// there is no batch, with kInvalidOption for options of another engine or unknown task names, with
/// kCancelled (running tasks are set back to waiting), and as the engine does.
Result<BatchOutcome> run_batch(const BatchRequest& request, const RunContext& context);

}  // namespace turnscan
