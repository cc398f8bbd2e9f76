#pragma once
// Many recordings with the same options, or one with many: what `turnscan batch run` does.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <turnscan/api/options.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <utility>
#include <vector>

namespace turnscan {

struct Batch {
  /// Recordings, folders with recordings below them, or one table of tasks (.csv, .toml). With the
  /// command "simulate": objects.
  std::vector<std::string> inputs;
  std::string command;  ///< "reconstruct" or "simulate"; empty: the table's, else reconstruct
  Options options;      ///< of every task; they take precedence over a table
  /// Every task is run once with each value of an option; with several options, once with each
  /// combination.
  std::vector<std::pair<std::string, std::vector<std::string>>> sweep;
  Options engine;  ///< how tasks are run: `jobs`, `task-threads`, `engine` (local or slurm), ...
  /// The turnscan program, which runs each task in a process of its own: a path, or a name that is
  /// looked up on the PATH.
  std::filesystem::path program = "turnscan";
  /// Called on every change with a line such as "12 of 200 done, 1 failed; 2 running". May be
  /// empty.
  std::function<void(const std::string&)> on_status;
};

struct BatchResult {
  std::size_t tasks = 0, done = 0, failed = 0;
  std::vector<std::string> files;  ///< the summary: summary.csv, .json and .html
};

/// Runs the tasks that are not done yet, and writes a summary. Every task has a folder of its own
/// inside `folder`, which is made if need be; what an earlier run completed is kept, unless its
/// input or options changed. A task that fails does not stop the others, and is no failure of the
/// batch.
///
/// Fails with kInvalidOption (naming the task), kNotFound (no recording, no program),
/// kAlreadyExists (the folder holds something else, or another run is active in it), kIo and
/// kCancelled; a later run then continues.
Result<BatchResult> run_batch(const Batch& batch, const std::filesystem::path& folder,
                              const RunContext& context = {});

/// Names that Batch::engine may have.
std::vector<OptionDescription> batch_engine_options();

}  // namespace turnscan
