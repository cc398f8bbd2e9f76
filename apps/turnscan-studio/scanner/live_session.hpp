#pragma once
// What the thread of a LiveFeed holds while a source is open.

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

  /// The frame as it is shown, counted and collected.
  void take(const Frame& frame);
  /// No frame came.
  void note_silence();
  /// Records until the limits of the request; fails where the source cannot go on.
  void record(const RecordingRequest& request, const RunContext& context);

 private:
  std::shared_ptr<const Calibration> calibration();
  /// As the recording will have it: where the table stands is in it, if that is known.
  SequenceHeader header_with_table();
  Result<CaptureResult> capture_now(const RecordingRequest& request, const RunContext& context);
  void begin_seen(const CaptureOptions& options);
  /// What the motion has shown meanwhile, if that is new.
  void take_motion(const std::shared_ptr<const Calibration>& shown);
  /// From now on frames are placed so, and those of before that are still there.
  void place_by(const LiveMotion& motion);
  void see(const Frame& frame);
  void count_seen(const Frame& frame, double turned_rad);
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

  // Of a recording.
  SequenceHeader header_;
  bool table_given_ = false;  ///< else header_ has the one that the motion has shown
  std::optional<double> speed_rad_s_, first_time_s_;
  std::shared_ptr<const Calibration> shown_;  ///< by the motion, as far as it was taken
  std::optional<LiveMotion> motion_;
  std::optional<LiveCoverage> seen_;
  std::unique_ptr<LiveSurface> surface_;
  TriangleMesh mesh_;  ///< the newest of surface_, table frame
  std::size_t surfaces_ = 0;
  /// Of the last frame of each sensor, the table turned back; where that is known.
  std::vector<std::optional<Pose>> T_turned_sensor_;
};

}  // namespace turnscan::studio
