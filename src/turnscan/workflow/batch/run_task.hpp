#pragma once
// One task from its folder to its result: what an engine starts, on whichever machine.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

struct TaskRunSettings {
  std::filesystem::path program;  ///< turnscan
  int threads = 1;                ///< of the command
};

/// Runs a task of a batch in a child process and keeps the result, or the reason why there is none,
/// beside the hash of what it was made of. Waits while another process runs the task, and does
/// nothing when it is done then. The result takes its place in one step: a kill at any moment
/// leaves the old one, none, or the new one. A task that fails is no failure of this. Fails with
/// kNotFound or kFormat where there is no such task, with kCancelled (the task is waiting again)
/// and with kIo.
Result<> run_task(const std::filesystem::path& folder, const std::string& name,
                  const TaskRunSettings& settings, const RunContext& context);

}  // namespace turnscan
