#pragma once
// A batch from its folder to its summary, by an engine.
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
  std::string engine_options;       ///< of sbatch
  std::optional<int> jobs;          ///< at once, local; nullopt: as cores and memory allow
  std::optional<int> task_threads;  ///< nullopt: 1, or the cores that too few tasks leave over
  int tasks_per_job = 1;            ///< Slurm: tasks that one element of an array runs
  int restarts = 2;                 ///< of a task whose process or node was lost
};

OptionTable describe(BatchRunOptions& options);

struct BatchRequest {
  std::string folder;
  BatchRunOptions options;
  std::filesystem::path program;   ///< turnscan, which runs each task
  bool retry_failed = false;       ///< failed tasks are run again
  std::vector<std::string> retry;  ///< these only, done or not; empty: all that failed
  bool detach = false;             ///< Slurm: hand the tasks over and do not wait for them
  /// Told about every change: "12 of 200 done, 1 failed; 2 running".
  std::function<void(const std::string&)> on_status;
};

struct BatchOutcome {
  std::size_t tasks = 0, done = 0, failed = 0, waiting = 0;
  std::size_t skipped = 0;  ///< of those done: that were done before
  double seconds = 0.0;
  std::vector<std::string> files;  ///< the summary
};

/// The program that this is.
std::filesystem::path own_program();

/// Makes the folder of a batch, or gives it these tasks in place of those that it has: results of
/// tasks that stay the same are kept. Fails with kAlreadyExists in a folder with other content or
/// while a run goes on in it, and with kIo.
Result<> save_batch(const std::string& folder, const std::vector<BatchTask>& tasks);

/// Runs what is not done, waits for it, and writes summary.csv, .json and .html. Failed tasks are
/// left alone, unless they changed or are to be retried, and stop no other. Tasks that an earlier,
/// killed run handed to Slurm are waited for, not handed over again.
/// Fails with kAlreadyExists while another run goes on in the folder, with kNotFound without a
/// batch, with kInvalidOption for options of another engine or names of no task, with kCancelled
/// (what ran is waiting again), and as the engine does.
Result<BatchOutcome> run_batch(const BatchRequest& request, const RunContext& context);

}  // namespace turnscan
