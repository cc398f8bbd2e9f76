#pragma once
// A program run to its end, or ended. Not installed.

#include <filesystem>
#include <span>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::detail {

struct ChildResult {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;
  std::string output;
  std::string errors;  ///< at most the first 64 KiB
};

/// Runs `program` with standard input from nowhere and waits for it. It is killed, and this fails,
/// when ctx is cancelled (kCancelled) or after seconds of wall time (kResourceLimit). Fails with
/// kIo when it cannot be started. May be called from any thread.
Result<ChildResult> run_child(const std::filesystem::path& program,
                              std::span<const std::string> arguments, double seconds,
                              const RunContext& ctx);

}  // namespace turnscan::detail
