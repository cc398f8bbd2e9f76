#pragma once
// Delivers frames of a recording or simulation in real time.

#include <algorithm>
#include <thread>
#include <turnscan/capture/source/grabber.hpp>

namespace turnscan::source {

class Pacer {
 public:
  /// rate: frame time per second of real time; 0: as fast as possible.
  explicit Pacer(double rate) : rate_(rate) {}

  bool live() const { return rate_ > 0.0; }
  /// Makes the frame of time_s due now.
  void restart(double time_s) {
    begin_s_ = steady_seconds();
    begin_time_s_ = time_s;
  }
  /// Delay of the frame of time_s: negative before it is due. 0 if not live.
  double lateness(double time_s) const { return live() ? steady_seconds() - due(time_s) : 0.0; }
  double due(double time_s) const { return begin_s_ + (time_s - begin_time_s_) / rate_; }
  /// Waits until the frame is due, at most timeout_s. Returns whether it is due.
  bool wait(double time_s, double timeout_s) const {
    const double early = -lateness(time_s);
    if (early <= 0.0) return true;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(early, timeout_s)));
    return early <= timeout_s;
  }

 private:
  double rate_;
  double begin_s_ = 0.0, begin_time_s_ = 0.0;
};

}  // namespace turnscan::source
