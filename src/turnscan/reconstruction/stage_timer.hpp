#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Adds its own lifetime to the time of a stage.
class StageTimer {
 public:
  StageTimer(std::vector<StageTime>& times, std::string stage)
      : times_(times), stage_(std::move(stage)) {}
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;
  ~StageTimer() {
    const double seconds = seconds_since(start_);
    const auto same = std::find_if(times_.begin(), times_.end(),
                                   [&](const StageTime& t) { return t.stage == stage_; });
    if (same != times_.end())
      same->seconds += seconds;
    else
      times_.push_back({stage_, seconds});
  }

 private:
  std::vector<StageTime>& times_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs a stage and adds its duration. Returns the stage's result.
template <class Stage>
auto timed(std::vector<StageTime>& times, const char* name, const Stage& stage) {
  const StageTimer timer(times, name);
  return stage();
}

}  // namespace turnscan
