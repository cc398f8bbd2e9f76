#pragma once
// A sensor that delivers on a thread of its own: what it sees now, and its recording.

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <turnscan/capture/session/capture.hpp>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

#include "app/another_side.hpp"
#include "view/drawable.hpp"

namespace turnscan::studio {

/// What a recording has seen of the object so far.
struct CoverageSummary {
  double area_m2 = 0.0, share_well = 0.0;
  /// Of the surface, as it would be closed now, that no frame has seen; nullopt: not known yet.
  std::optional<double> share_missing;
  int sides = 0;
  std::size_t surfaces = 0;  ///< how many there have been
  bool is_surface = false;   ///< the picture is a mesh, else points
  DrawablePtr picture;       ///< sensor frame, as the table stands now; nullptr once taken
};

/// What is shown of a sensor. Copied out as a whole.
struct LiveState {
  bool open = false;
  std::string error;  ///< why it is not open any more; empty: nothing went wrong
  std::string device;
  std::uint64_t frames = 0, dropped = 0;
  double fps = 0.0;
  std::size_t points = 0;
  bool table_known = false;  ///< by a calibration, or the source says it
  /// Of this very device, from the last time that it was used; nullptr once taken.
  std::shared_ptr<const Calibration> kept;
  DrawablePtr picture;          ///< of the last frame, sensor frame; nullptr once taken
  std::size_t averaged = 0;     ///< frames collected of those asked for
  std::optional<RigCheck> rig;  ///< the platter beside the calibration; nullopt: not looked at

  bool recording = false;
  CaptureProgress progress;
  std::optional<CoverageSummary> seen;  ///< nullopt: it is not known how the table turns
  std::string record_error;
  std::string outcome;   ///< of a recording that has just ended: what was recorded and lost
  std::string finished;  ///< its folder, where there is one; else empty
};

struct RecordingRequest {
  std::string folder;
  CaptureOptions options;
  std::string motor_port;  ///< empty: nobody turns the table from here
  MotorOptions motor;
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
  /// The same without waiting: ended() tells when.
  void cancel();
  bool running() const { return thread_.joinable(); }
  /// Nothing comes any more; stop() would not wait.
  bool ended() const { return ended_; }

  void set_filter(bool on) { filter_ = on; }
  /// How many points of a picture are drawn, at most.
  void set_most_points(std::size_t most) { most_points_ = most; }
  void set_calibration(std::shared_ptr<const Calibration> calibration);
  /// Collects frames for an averaged scan.
  void collect(std::size_t frames);
  /// The collected frames with the header of their source, once all are there.
  std::unique_ptr<FrameSequence> take_collected();
  void record(const RecordingRequest& request);
  /// Lays the object so, where the source can; where it cannot, somebody does it by hand.
  void lay_object(const ObjectTurn& turn);
  void stop_recording();

  LiveState take_state();

 private:
  struct Session;
  void run(const std::string& uri, const RunContext& context);
  Result<> lay_now(FrameSource& source);
  void fail_with(const Error& error);

  std::thread thread_;
  std::unique_ptr<RunContext> context_;
  std::atomic<bool> filter_ = false, ended_ = true;
  std::atomic<std::size_t> most_points_ = 40000;
  std::mutex mutex_;  // guards what follows
  LiveState state_;
  std::shared_ptr<const Calibration> calibration_;
  std::optional<RecordingRequest> request_;
  std::optional<ObjectTurn> turn_;
  RunContext recording_context_;  ///< of the recording that is asked for, or runs
  std::size_t wanted_ = 0;
  std::vector<Frame> collected_;
  SequenceHeader header_;
};

}  // namespace turnscan::studio
