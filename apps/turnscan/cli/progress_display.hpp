#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <turnscan/core/run_context.hpp>

#include "cli/command.hpp"

namespace turnscan::cli {

enum class RunEnd { kDone, kFailed };

/// Shows the progress of a run on standard error: the phase, the percentage of the whole run and
/// the remaining time; if the total is not known, the phase and its elapsed time. On a terminal
/// that is a bar; elsewhere a line when a phase begins, and during it one every 10 s, or every 10 %
/// if those are at least a second apart.
class ProgressDisplay {
 public:
  /// status: shown next to the phase; must outlive this.
  ProgressDisplay(RunContext context, const StatusLine& status, bool quiet);
  ~ProgressDisplay() { finish(RunEnd::kFailed); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Hides the display until it is called with false.
  void pause(bool paused);

  /// Sets the remaining phases.
  void plan(PhasePlan phases);

  /// Stops listening and removes the bar. Calls after the first have no effect.
  void finish(RunEnd end);

 private:
  using Clock = std::chrono::steady_clock;

  void on_progress(const Progress& progress);
  void tick();
  void update();
  void draw_bar() const;
  void write_line();
  /// "12 % read frames"
  std::string phase_text() const;
  /// "40 s left", or the elapsed time of the phase
  std::string state_text() const;

  RunContext context_;
  const StatusLine& status_;
  const bool quiet_;
  const bool terminal_;
  std::mutex mutex_;  // guards the following members
  std::condition_variable wake_;
  bool finished_ = false, paused_ = false;
  Progress progress_;
  OverallProgress overall_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point paused_at_;
  Clock::time_point phase_begin_;
  Clock::time_point last_line_;
  double last_fraction_ = 0.0;  // of the whole run
  std::thread ticker_;
};

}  // namespace turnscan::cli
