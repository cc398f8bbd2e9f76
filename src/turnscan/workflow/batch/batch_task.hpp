#pragma once
// One piece of work of a batch: a command of the program, its inputs and its options.

#include <cstdint>
#include <string>
#include <turnscan/core/result.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Names of options as on the command line, without dashes, and values. A name may come twice where
/// the command line takes the option twice.
using BatchOptions = std::vector<std::pair<std::string, std::string>>;

struct BatchTask {
  std::string name;                     ///< unique in a batch, and the name of its folder
  std::string command = "reconstruct";  ///< or "simulate"
  /// Absolute paths of recordings, or the object to simulate (file or builtin:NAME).
  std::vector<std::string> inputs;
  BatchOptions options;
  std::uint64_t frames = 0;      ///< how much there is to do, for the order and the time left
  std::uint64_t peak_bytes = 0;  ///< of memory, estimated
};

/// Succeeds when the command is one of a batch's, it has inputs, its options exist and their values
/// can be read. Fails with kInvalidOption, naming the task.
Result<> check_task(const BatchTask& task);

/// What the program is called with, in the folder in which its outputs are to be.
std::vector<std::string> arguments_of(const BatchTask& task, int threads);

/// The inputs, and the files that options name.
std::vector<std::string> files_of(const BatchTask& task);

/// A path among an option's value, made absolute as seen from a folder; other values as they are.
std::string with_absolute_path(const std::string& option, const std::string& value,
                               const std::string& folder);

/// JSON of a task, and back. task_of() fails with kFormat.
std::string task_json(const BatchTask& task);
Result<BatchTask> task_of(const std::string& json);

}  // namespace turnscan
