#pragma once
// A task of a batch: a command of the program, its inputs and its options.

#include <cstdint>
#include <string>
#include <turnscan/core/result.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Option names as on the command line but without dashes, and their values. A name may occur twice
/// where the command line accepts the option twice.
using BatchOptions = std::vector<std::pair<std::string, std::string>>;

struct BatchTask {
  std::string name;                     ///< unique in a batch; also the name of its folder
  std::string command = "reconstruct";  ///< or "simulate"
  /// Absolute paths of recordings, or the object to simulate (file or builtin:NAME).
  std::vector<std::string> inputs;
  BatchOptions options;
  std::uint64_t frames = 0;      ///< amount of work, for ordering and for the time estimate
  std::uint64_t peak_bytes = 0;  ///< estimated peak memory
};

/// Succeeds if a batch can run the command, the task has inputs, its options exist and their values
/// are valid. Fails with kInvalidOption, naming the task.
Result<> check_task(const BatchTask& task);

/// Command-line arguments of the program, to be run in the output folder.
std::vector<std::string> arguments_of(const BatchTask& task, int threads);

/// The inputs and the files that options refer to.
std::vector<std::string> files_of(const BatchTask& task);

/// Makes the path in an option's value absolute, relative to a folder; returns other values
/// unchanged.
std::string with_absolute_path(const std::string& option, const std::string& value,
                               const std::string& folder);

/// Converts a task to JSON and back. task_of() fails with kFormat.
std::string task_json(const BatchTask& task);
Result<BatchTask> task_of(const std::string& json);

}  // namespace turnscan
