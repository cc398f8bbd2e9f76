#pragma once

#include <thread>
#include <turnscan/core/run_context.hpp>

namespace turnscan::cli {

/// Exit code of the process, the shells' convention for SIGINT.
inline constexpr int kExitCancelled = 130;

/// Turns the first Ctrl-C (SIGINT), SIGTERM or SIGHUP into RunContext::cancel(); the second ends
/// the process at once with kExitCancelled. Must be constructed before any other thread starts: it
/// blocks the signals for all threads and for child processes, so that a Ctrl-C in a terminal ends
/// children only through their parent. A signal that was ignored from the start (nohup) stays
/// ignored.
class InterruptWatch {
 public:
  explicit InterruptWatch(RunContext context);
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  void watch(const RunContext& context) const;

  int signals_ = -1;  // file descriptors
  int stop_ = -1;
  std::thread thread_;
};

}  // namespace turnscan::cli
