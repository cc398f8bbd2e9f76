#pragma once
// Hashes of everything that a result depends on.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <vector>

namespace turnscan::batch {

/// Fingerprint of an input at the time a task read it.
struct InputPrint {
  std::string path;
  std::string stamp;   ///< hash of its files' names, sizes and times: cheap to compare
  std::string sha256;  ///< hash of names and contents
};

/// Fingerprint of a file, of a folder with all files below it, or of the name itself if it is not a
/// path (builtin:cube). Fails with kNotFound or kIo.
Result<std::string> stamp_of(const std::string& path);
Result<InputPrint> print_of(const std::string& path);

/// Fingerprints of all files of a task.
Result<std::vector<InputPrint>> prints_of(const BatchTask& task);

/// Digest that is stored with a result: hash of command, options, version and contents of the
/// inputs.
std::string digest_of(const BatchTask& task, const std::vector<InputPrint>& inputs);

/// Whether a result with this digest, made from these inputs, is up to date for the task. Contents
/// are read only if a stamp differs. False if an input is missing.
bool is_current(const BatchTask& task, const std::string& digest,
                const std::vector<InputPrint>& inputs);

}  // namespace turnscan::batch
