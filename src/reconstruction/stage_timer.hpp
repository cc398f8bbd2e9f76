#pragma once

#include <algorithm>
#include <chrono>
#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// Adds what passes between its construction and its end to the time of a stage.
class StageTimer {
 public:
  StageTimer(Reconstruction& out, std::string stage) : out_(out), stage_(std::move(stage)) {}
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;
  ~StageTimer() {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const auto same = std::find_if(out_.stages.begin(), out_.stages.end(),
                                   [&](const StageTime& t) { return t.stage == stage_; });
    if (same != out_.stages.end())
      same->seconds += seconds;
    else
      out_.stages.push_back({stage_, seconds});
  }

 private:
  Reconstruction& out_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace turnscan
