#pragma once
// A live sensor on a separate thread: its current picture, and its recording.

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

/// Coverage of the object by the recording so far.
struct CoverageSummary {
  double area_m2 = 0.0, share_well = 0.0;
  /// Share of the surface, as it would be closed now, that no frame has seen; nullopt: not known
  /// yet.
  std::optional<double> share_missing;
  int sides = 0;
  std::size_t surfaces = 0;  ///< number of surfaces so far
  bool is_surface = false;   ///< the picture is a mesh, else points
  DrawablePtr picture;       ///< sensor frame, at the table's current angle; nullptr once taken
};

/// Displayed state of a sensor. Copied as a whole.
struct LiveState {
  bool open = false;
  std::string error;  ///< why it is no longer open; empty: no error
  std::string device;
  std::uint64_t frames = 0, dropped = 0;
  double fps = 0.0;
  std::size_t points = 0;
  bool table_known = false;  ///< by a calibration, or from the source
  /// Calibration stored for this device when it was last used; nullptr once taken.
  std::shared_ptr<const Calibration> kept;
  DrawablePtr picture;       ///< of the last frame, sensor frame; nullptr once taken
  std::size_t averaged = 0;  ///< number of requested frames collected
  /// As seen while there is no calibration, in an average of a few frames; nullopt: not looked
  /// for, or not found, with the reason.
  std::optional<DetectedPlatter> platter;
  std::string no_platter;
  /// Comparison of the platter with the calibration; nullopt: not checked.
  std::optional<RigCheck> rig;

  bool recording = false;
  CaptureProgress progress;
  std::optional<CoverageSummary> seen;  ///< nullopt: the rotation of the table is not known
  std::string record_error;
  std::string outcome;   ///< for a recording that has just ended: what was recorded and lost
  DrawablePtr surface;   ///< its last one, table frame; nullptr: none
  std::string finished;  ///< its folder, if it exists; else empty
};

struct RecordingRequest {
  std::string folder;
  CaptureOptions options;
  std::string motor_port;  ///< empty: no motor
  MotorOptions motor;
};

/// All members must be called from the window's thread.
class LiveFeed {
 public:
  LiveFeed() = default;
  ~LiveFeed() { stop(); }
  LiveFeed(const LiveFeed&) = delete;
  LiveFeed& operator=(const LiveFeed&) = delete;

  /// Opens the sensor of a URI and starts it; errors appear in the state.
  void start(const std::string& uri);
  /// Ends everything; a recording keeps all complete frames and is finished. Waits for the thread.
  void stop();
  /// The same without waiting; see ended().
  void cancel();
  bool running() const { return thread_.joinable(); }
  /// The thread has finished; stop() would not wait.
  bool ended() const { return ended_; }

  void set_filter(bool on) { filter_ = on; }
  /// Maximum number of points drawn in a picture.
  void set_most_points(std::size_t most) { most_points_ = most; }
  void set_calibration(std::shared_ptr<const Calibration> calibration);
  /// Collects frames for an averaged scan.
  void collect(std::size_t frames);
  /// The collected frames with the header of their source, once all have arrived.
  std::unique_ptr<FrameSequence> take_collected();
  void record(const RecordingRequest& request);
  /// Repositions the object if the source can; otherwise the user does it by hand.
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
  std::mutex mutex_;  // guards the following members
  LiveState state_;
  std::shared_ptr<const Calibration> calibration_;
  std::optional<RecordingRequest> request_;
  std::optional<ObjectTurn> turn_;
  RunContext recording_context_;  ///< of the requested or running recording
  std::size_t wanted_ = 0;
  std::vector<Frame> collected_;
  SequenceHeader header_;
};

}  // namespace turnscan::studio
