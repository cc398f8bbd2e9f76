#pragma once
// A program that runs in the background.

#include <sys/types.h>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan::process {

/// Exit status and resource use of a program.
struct ProcessEnd {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;
  /// Largest resident set of the program or of a child that it waited for.
  std::uint64_t peak_bytes = 0;
  double cpu_seconds = 0.0;  ///< including the children that it waited for
};

/// The program is killed (SIGKILL) with the thread that started it or with this object, whichever
/// ends first. It runs in a process group of its own: Ctrl-C in a terminal does not reach it.
class BackgroundProcess {
 public:
  /// Starts the program in this folder (empty: this process's). Its standard input is empty; output
  /// and errors are appended to log, which is created if necessary. Fails with kIo if no process
  /// can be created; a program that cannot be started exits with 127.
  static Result<BackgroundProcess> start(const std::filesystem::path& program,
                                         std::span<const std::string> arguments,
                                         const std::filesystem::path& log,
                                         const std::filesystem::path& folder = {});
  BackgroundProcess(BackgroundProcess&& other) noexcept;
  BackgroundProcess& operator=(BackgroundProcess&& other) noexcept;
  ~BackgroundProcess();

  /// nullopt while it runs. Must not be called again after it has returned a value.
  std::optional<ProcessEnd> poll();
  /// Sends SIGTERM, or SIGKILL if `now`.
  void stop(bool now) const;

 private:
  explicit BackgroundProcess(pid_t child) : child_(child) {}
  pid_t child_ = -1;
};

}  // namespace turnscan::process
