#pragma once
// A sensor that delivers on a thread of its own: what it sees now, and its recording.

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

#include "drawable.hpp"

namespace turnscan::studio {

/// What is shown of a sensor. Copied out as a whole.
struct LiveState {
  bool open = false;
  std::string error;  ///< why it is not open any more; empty: nothing went wrong
  std::string device;
  std::uint64_t frames = 0, dropped = 0;
  double fps = 0.0;
  std::size_t points = 0;
  DrawablePtr picture;       ///< of the last frame, sensor frame; nullptr once taken
  std::size_t averaged = 0;  ///< frames collected of those asked for

  bool recording = false;
  std::uint64_t recorded = 0;
  std::optional<double> turns;  ///< since the recording began; unknown without angles or speed
  std::string finished;         ///< folder of a recording that has just ended; else empty
};

struct RecordingWish {
  std::string folder;
  double turns = 1.0;  ///< 0: until it is stopped
  std::optional<double> speed_rad_s;
};

/// All members from the thread of the window.
class LiveFeed {
 public:
  LiveFeed() = default;
  ~LiveFeed() { stop(); }
  LiveFeed(const LiveFeed&) = delete;
  LiveFeed& operator=(const LiveFeed&) = delete;

  /// Opens the sensor of a URI and begins; errors appear in state().
  void start(const std::string& uri);
  /// Ends everything; a recording keeps all whole frames and is finished. Waits for the thread.
  void stop();
  bool running() const { return thread_.joinable(); }

  void set_filter(bool on) { filter_ = on; }
  void set_calibration(std::shared_ptr<const Calibration> calibration);
  /// Collects frames for an averaged scan.
  void collect(std::size_t frames);
  /// The collected frames with the header of their source, once all are there.
  std::unique_ptr<FrameSequence> take_collected();
  void record(const RecordingWish& wish);
  void stop_recording() { stop_recording_ = true; }

  LiveState take_state();

 private:
  struct Session;
  void run(const std::string& uri, const RunContext& context);
  void fail_with(const Error& error);

  std::thread thread_;
  std::unique_ptr<RunContext> context_;
  std::atomic<bool> filter_ = false, stop_recording_ = false;
  std::mutex mutex_;  // guards what follows
  LiveState state_;
  std::shared_ptr<const Calibration> calibration_;
  std::optional<RecordingWish> wish_;
  std::size_t wanted_ = 0;
  std::vector<Frame> collected_;
  SequenceHeader header_;
};

}  // namespace turnscan::studio
