#pragma once
// What a result depends on, as a hash.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <vector>

namespace turnscan::batch {

/// An input as it was when a task read it.
struct InputPrint {
  std::string path;
  std::string stamp;   ///< hash of names, sizes and times of its files: cheap to compare
  std::string sha256;  ///< hash of names and contents
};

/// Of a file, a folder with all files below it, or of what is no path (builtin:cube) its name.
/// Fails with kNotFound or kIo.
Result<std::string> stamp_of(const std::string& path);
Result<InputPrint> print_of(const std::string& path);

/// Of all files of a task.
Result<std::vector<InputPrint>> prints_of(const BatchTask& task);

/// What stands beside a result: hash of command, options, version and contents of the inputs.
std::string digest_of(const BatchTask& task, const std::vector<InputPrint>& inputs);

/// Whether a result with this digest, made of these inputs, is the task's: contents are read only
/// where a stamp differs. False where an input is missing.
bool is_current(const BatchTask& task, const std::string& digest,
                const std::vector<InputPrint>& inputs);

}  // namespace turnscan::batch
