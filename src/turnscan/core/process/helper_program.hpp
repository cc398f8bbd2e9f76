#pragma once
// The programs in libexec/turnscan, which run libraries that may crash, hang, take too much memory,
// or cannot be cancelled. A failing one writes a line "CODE: SENTENCE" to standard error, where
// CODE is the name of an ErrorCode. Not installed.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <turnscan/core/process/child_process.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::process {

/// Looks in the folder named by the environment variable TURNSCAN_LIBEXEC, and only there if it is
/// set; else near the running executable (libexec/turnscan of the installation or of the build
/// tree), then in the installation folder. Fails with kMissingData if it is in none of them.
Result<std::filesystem::path> find_helper_program(const std::string& name);

/// The error written by a helper program; nullopt if there is none.
std::optional<Error> helper_error(const ChildResult& child);

/// Resource limits of a helper program; nullopt: unlimited.
struct ProcessLimits {
  /// Address space. Ignored under sanitizers, which need more of it than any limit.
  std::optional<std::uint64_t> memory_bytes = std::nullopt;
  std::optional<std::uint64_t> file_bytes = std::nullopt;
  std::optional<std::uint64_t> cpu_seconds = std::nullopt;
};

/// Limits this process, disables core dumps, and makes it end together with the process that
/// started it.
void limit_this_process(const ProcessLimits& limits);

}  // namespace turnscan::process
