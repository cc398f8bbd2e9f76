#pragma once
// Whether the platter is still where the calibration has it, looked at now and then.

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

/// Averages a few frames and compares them on a thread of its own; nobody waits for it.
class RigWatch {
 public:
  static constexpr std::size_t kFrames = 6;  ///< averaged for one look
  static constexpr double kPause_s = 4.0;    ///< between two looks

  ~RigWatch();

  /// Frames of sensor 0, as they come. Another calibration begins anew; nullptr: there is nothing
  /// to compare with. header: of the frames.
  void take(const Frame& frame, const SequenceHeader& header,
            const std::shared_ptr<const Calibration>& calibration);
  /// The last look; nullopt: none yet with this calibration.
  const std::optional<RigCheck>& found() const { return found_; }

 private:
  void collect_result();

  using Clock = std::chrono::steady_clock;
  std::shared_ptr<const Calibration> calibration_;
  std::vector<Frame> frames_;
  std::optional<RigCheck> found_;
  std::future<Result<RigCheck>> look_;
  bool outdated_ = false;  ///< look_ is by another calibration
  Clock::time_point last_ = Clock::now() - std::chrono::minutes(1);
  RunContext context_;
};

}  // namespace turnscan::studio
