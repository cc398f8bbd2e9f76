#pragma once
// State of a LiveFeed's thread while a source is open.

#include <chrono>
#include <turnscan/core/camera.hpp>
#include <turnscan/workflow/scan/live_surface.hpp>

#include "scanner/live_coverage.hpp"
#include "scanner/live_feed.hpp"
#include "scanner/live_picture.hpp"
#include "scanner/rig_watch.hpp"

namespace turnscan::studio {

struct LiveFeed::Session {
  using Clock = std::chrono::steady_clock;

  Session(LiveFeed& feed, FrameSource& source);

  /// Displays, counts and collects a frame.
  void take(const Frame& frame);
  /// Call when no frame arrived.
  void note_silence();
  /// Records until the limits of the request; fails if the source cannot continue.
  void record(const RecordingRequest& request, const RunContext& context);

 private:
  std::shared_ptr<const Calibration> calibration();
  /// The header for the recording, including the pose of the table, if that is known.
  SequenceHeader header_with_table();
  Result<CaptureResult> capture_now(const RecordingRequest& request, const RunContext& context);
  void begin_seen(const CaptureOptions& options);
  /// Takes over a new motion estimate, if there is one.
  void take_motion(const std::shared_ptr<const Calibration>& shown);
  /// Uses this motion for all further frames, and for the earlier ones that are still kept.
  void place_by(const LiveMotion& motion);
  void see(const Frame& frame);
  void count_seen(const Frame& frame, double turned_rad);
  void take_surface();
  void show_seen(double turned_rad);
  DrawablePtr draw_surface(const TriangleMesh& mesh, const Pose& T_sensor_table,
                           double& share_missing) const;
  DrawablePtr draw_cells(const Pose& T_sensor_table) const;
  void show(const Frame& frame);
  DrawablePtr draw(const Frame& frame, std::size_t& count);
  Tint tint_of(std::size_t sensor) const;

  LiveFeed& feed_;
  FrameSource& source_;
  std::vector<RayTable> rays_;
  Clock::time_point last_picture_ = Clock::now(), last_rate_ = Clock::now();
  Clock::time_point last_seen_ = Clock::now(), last_frame_ = Clock::now();
  std::uint64_t frames_at_rate_ = 0;
  double fps_ = 0.0;

  RigWatch rig_watch_;

  // State of a recording.
  SequenceHeader header_;
  std::optional<LiveMotionFinder> finder_;
  std::optional<LiveMotion> motion_;
  std::optional<LiveCoverage> seen_;
  std::unique_ptr<LiveSurface> surface_;
  TriangleMesh mesh_;  ///< the latest of surface_, table frame
  std::size_t surfaces_ = 0;
  /// Pose for the last frame of each sensor with the table's rotation removed; if known.
  std::vector<std::optional<Pose>> T_turned_sensor_;
};

}  // namespace turnscan::studio
