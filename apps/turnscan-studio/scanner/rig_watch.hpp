#pragma once
// Periodically checks whether the platter still is where the calibration has it.

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::studio {

/// Averages a few frames and compares them on a separate thread; nobody waits for it.
class RigWatch {
 public:
  static constexpr std::size_t kFrames = 6;  ///< averaged for one check
  static constexpr double kPause_s = 4.0;    ///< between two checks

  ~RigWatch();

  /// Passes the frames of sensor 0 as they arrive. A different calibration restarts the check;
  /// nullptr: there is nothing to compare with. header: of the frames.
  void take(const Frame& frame, const SequenceHeader& header,
            const std::shared_ptr<const Calibration>& calibration);
  /// The last result; nullopt: none yet with this calibration.
  const std::optional<RigCheck>& found() const { return found_; }

 private:
  void collect_result();

  using Clock = std::chrono::steady_clock;
  std::shared_ptr<const Calibration> calibration_;
  std::vector<Frame> frames_;
  std::optional<RigCheck> found_;
  std::future<Result<RigCheck>> look_;
  bool outdated_ = false;  ///< look_ uses an outdated calibration
  Clock::time_point last_ = Clock::now() - std::chrono::minutes(1);
  RunContext context_;
};

}  // namespace turnscan::studio
