#pragma once
// Runs one task from its folder to its result; this is what an engine starts, on any machine.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

struct TaskRunSettings {
  std::filesystem::path program;  ///< the turnscan executable
  int threads = 1;                ///< used by the command
};

/// Runs a task of a batch in a child process and stores the result, or the reason why there is
/// none, together with the hash of its inputs. Waits while another process runs the task, and does
/// nothing if the task is done afterwards. The result is replaced atomically: a kill at any moment
/// leaves the old one, none, or the new one. A failing task is not an error of this function. Fails
/// with kNotFound or kFormat if there is no such task, with kCancelled (the task is set back to
/// waiting) and with kIo.
Result<> run_task(const std::filesystem::path& folder, const std::string& name,
                  const TaskRunSettings& settings, const RunContext& context);

}  // namespace turnscan
