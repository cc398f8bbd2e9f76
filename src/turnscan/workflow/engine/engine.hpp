#pragma once
// What runs the tasks of a batch: this machine, or a cluster's scheduler. An engine knows names and
// how much memory each may need; whether a task succeeded stands in the task's folder.

#include <cstdint>
#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::engine {

struct Job {
  std::string name;  ///< of a task; without spaces
  std::uint64_t peak_bytes = 0;
};

/// A job that has left the engine, however that came.
struct Ended {
  std::string name;
  std::string reason;  ///< what the engine says of an end that was not in order; may be empty
  bool lost = false;   ///< the machine failed, not the task: it is to be run again
};

/// The program and arguments that run the task NAME: PROGRAM ARGUMENTS... NAME.
struct JobCommand {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  int threads = 1;
};

/// Not for several threads at once.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Jobs that an earlier run handed over and that have not ended; poll() will tell of them.
  virtual Result<std::vector<std::string>> adopt() = 0;
  /// Takes jobs over, in the order in which they are to begin.
  virtual Result<> submit(const std::vector<Job>& jobs) = 0;
  /// Those that have ended since the last call; waits a little if there are none. Fails only when
  /// the engine is lost for good.
  virtual Result<std::vector<Ended>> poll() = 0;
  /// Ends all jobs, and waits for that.
  virtual void cancel() = 0;
  /// What it is doing, for people: "4 at once".
  virtual std::string status() const = 0;
};

}  // namespace turnscan::engine
