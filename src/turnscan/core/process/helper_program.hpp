#pragma once
// The programs in libexec/turnscan, in which libraries run that may crash, hang or take too much
// memory, or that cannot be cancelled. One that fails says so in a line on standard error,
// "CODE: SENTENCE", where CODE is the name of an ErrorCode. Not installed.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <turnscan/core/process/child_process.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::process {

/// Looks in the folder that the environment names (TURNSCAN_LIBEXEC), and only there if it names
/// one; else near the running executable (libexec/turnscan of the installation or of the build
/// tree), then where it was to be installed. Fails with kMissingData where it is in none of them.
Result<std::filesystem::path> find_helper_program(const std::string& name);

/// The error that a helper program has written; nullopt when there is none.
std::optional<Error> helper_error(const ChildResult& child);

/// What a helper program may use; nullopt: as much as there is.
struct ProcessLimits {
  /// Address space. Not under sanitizers, which need more of it than any limit.
  std::optional<std::uint64_t> memory_bytes = std::nullopt;
  std::optional<std::uint64_t> file_bytes = std::nullopt;
  std::optional<std::uint64_t> cpu_seconds = std::nullopt;
};

/// Limits this process, which dumps no core, and lets it end together with the one that started it.
void limit_this_process(const ProcessLimits& limits);

}  // namespace turnscan::process
