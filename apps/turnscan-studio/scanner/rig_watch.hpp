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
#include <turnscan/core/sequence_views.hpp>
#include <vector>

namespace turnscan::studio {

/// Averages a few frames and compares them on a separate thread; nobody waits for it.
class RigWatch {
 public:
  static constexpr std::size_t kFrames = 6;  ///< averaged for one check
  static constexpr double kPause_s = 4.0;    ///< between two checks

  ~RigWatch();

  /// Passes the frames of sensor 0 as they arrive. A different calibration restarts the check;
  /// nullptr: the platter is looked for. header: of the frames.
  void take(const Frame& frame, const SequenceHeader& header,
            const std::shared_ptr<const Calibration>& calibration);
  /// The last result; nullopt: none yet with this calibration.
  const std::optional<RigCheck>& found() const { return found_; }
  /// The last that was seen without a calibration; nullopt: none yet, or why there is none.
  const std::optional<DetectedPlatter>& platter() const { return platter_; }
  const std::string& no_platter() const { return no_platter_; }

 private:
  void collect_result();

  using Clock = std::chrono::steady_clock;
  std::shared_ptr<const Calibration> calibration_;
  std::vector<Frame> frames_;
  std::optional<RigCheck> found_;
  /// What a look has found: a comparison, or a platter.
  struct Look {
    std::optional<RigCheck> rig;
    std::optional<DetectedPlatter> platter;
  };
  static Result<Look> look_at(const MemoryFrames& frames, const Calibration* calibration,
                              const RunContext& context);
  std::future<Result<Look>> look_;
  std::optional<DetectedPlatter> platter_;
  std::string no_platter_;
  bool outdated_ = false;  ///< look_ uses an outdated calibration
  Clock::time_point last_ = Clock::now() - std::chrono::minutes(1);
  RunContext context_;
};

}  // namespace turnscan::studio
