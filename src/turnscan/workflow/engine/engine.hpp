#pragma once
// Runs the tasks of a batch on this machine or by a cluster's scheduler. An engine knows the tasks'
// names and how much memory each may need; whether a task succeeded is recorded in the task's
// folder.

#include <cstdint>
#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::engine {

struct Job {
  std::string name;  ///< of a task; contains no spaces
  std::uint64_t peak_bytes = 0;
};

/// A job that has left the engine, for whatever reason.
struct Ended {
  std::string name;
  std::string reason;  ///< the engine's explanation of an abnormal end; may be empty
  bool lost = false;   ///< the machine failed, not the task: it has to be run again
};

/// Program and arguments that run the task NAME: PROGRAM ARGUMENTS... NAME.
struct JobCommand {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  int threads = 1;
};

/// Not thread-safe.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Jobs that an earlier run submitted and that have not ended; poll() will report them.
  virtual Result<std::vector<std::string>> adopt() = 0;
  /// Submits jobs, in the order in which they should start.
  virtual Result<> submit(const std::vector<Job>& jobs) = 0;
  /// Jobs that have ended since the last call; waits a little if there are none. Fails only if the
  /// engine is permanently lost.
  virtual Result<std::vector<Ended>> poll() = 0;
  /// Terminates all jobs and waits until they have ended.
  virtual void cancel() = 0;
  /// Human-readable status: "4 at once".
  virtual std::string status() const = 0;
};

}  // namespace turnscan::engine
