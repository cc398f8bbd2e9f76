#pragma once
// The surface of what is recorded, made only while somebody asks for it.

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <turnscan/workflow/scan/live_surface.hpp>

namespace turnscan::serve {

class GrowingSurface {
 public:
  /// Nothing is made for whoever asked longer ago.
  static constexpr std::chrono::seconds kWanted{5};

  // --- from the recording thread, which never waits for a mesh

  /// Forgets the surface of what was recorded before.
  void clear();
  void begin(const CaptureSetup& setup);
  void add(const Frame& frame);
  void take(const std::shared_ptr<const Calibration>& motion);
  /// The last mesh stays.
  void end();

  // --- from any thread

  /// The newest mesh, in the form of web/packed_model.js. Nothing is made before the first call in
  /// a recording, and frames from before it are not in it.
  struct Shown {
    std::uint64_t number = 0;  ///< another one for each mesh; 0: there is none
    std::size_t frames = 0;    ///< that it was made from
    std::string model;         ///< JSON
  };
  std::shared_ptr<const Shown> newest();

 private:
  using Clock = std::chrono::steady_clock;
  void place_by(const std::optional<LiveMotion>& motion);

  std::mutex mutex_;
  std::optional<SequenceHeader> header_;  ///< of the recording that runs
  std::optional<LiveMotionFinder> finder_;
  std::optional<LiveMotion> motion_;
  std::unique_ptr<LiveSurface> surface_;
  Clock::time_point asked_;
  std::uint64_t number_ = 0, since_ = 0;  // the last, and that of clear()
  std::shared_ptr<const Shown> shown_ = std::make_shared<const Shown>();
};

}  // namespace turnscan::serve
