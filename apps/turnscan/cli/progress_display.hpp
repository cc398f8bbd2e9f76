#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <turnscan/core/run_context.hpp>

#include "cli/command.hpp"

namespace turnscan::cli {

/// Shows the progress of a run on standard error: a bar with the time left in the phase on a
/// terminal; elsewhere a line when a phase begins, and within it one every 10 s, or every 10 % if
/// those are a second or more apart.
class ProgressDisplay {
 public:
  /// status: shown beside the phase; must outlive this.
  ProgressDisplay(RunContext context, const StatusLine& status, bool quiet);
  ~ProgressDisplay() { finish(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows nothing until it is called with false.
  void pause(bool paused);

  /// Stops listening and removes the bar. May be called more than once.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void on_progress(const Progress& progress);
  void tick();
  void draw_bar() const;
  void write_line(Clock::time_point now);
  std::string state_text() const;

  RunContext context_;
  const StatusLine& status_;
  const bool quiet_;
  const bool terminal_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  bool finished_ = false, paused_ = false;
  Progress progress_;
  Clock::time_point phase_begin_;
  Clock::time_point last_line_;
  double last_fraction_ = 0.0;
  std::thread ticker_;
};

}  // namespace turnscan::cli
