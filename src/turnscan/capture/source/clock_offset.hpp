#pragma once
// Offset between the clock of a sensor and that of this machine.

#include <cmath>
#include <cstddef>
#include <limits>

namespace turnscan::source {

/// A frame cannot arrive before it was taken: the frame with the shortest delay determines the
/// offset best (as in Cristian 1989, "Probabilistic clock synchronization"). The remaining error is
/// that shortest delay, a few milliseconds that are common to sensors of one kind.
class ClockOffset {
 public:
  void add(double sensor_time_s, double host_time_s) {
    const double offset_s = host_time_s - sensor_time_s;
    if (!std::isfinite(offset_s)) return;
    ++count_;
    if (offset_s < least_s_) least_s_ = offset_s;
  }
  std::size_t count() const { return count_; }
  /// To be added to sensor times; 0 without a frame.
  double to_host_s() const { return count_ > 0 ? least_s_ : 0.0; }

 private:
  double least_s_ = std::numeric_limits<double>::infinity();
  std::size_t count_ = 0;
};

}  // namespace turnscan::source
