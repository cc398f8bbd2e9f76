#pragma once
// Runs a program to its end, with a time limit.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::process {

struct ChildResult {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;
  std::string output;
  std::string errors;  ///< at most the first 64 KiB
};

/// Runs `program` with `input` as its standard input and waits for it. It is killed, and this
/// fails, if ctx is cancelled (kCancelled) or after `seconds` of wall time (kResourceLimit). Fails
/// with kIo if it cannot be started or its input cannot be kept in memory. May be called from any
/// thread.
Result<ChildResult> run_child(const std::filesystem::path& program,
                              std::span<const std::string> arguments, double seconds,
                              const RunContext& ctx, std::string_view input = {});

}  // namespace turnscan::process
