#pragma once
// What the thread of a LiveFeed holds while a source is open.

#include <chrono>
#include <turnscan/core/camera.hpp>

#include "scanner/live_coverage.hpp"
#include "scanner/live_feed.hpp"
#include "scanner/live_picture.hpp"

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
  void begin_seen(const SequenceHeader& header, const CaptureOptions& options);
  void see(const Frame& frame);
  void show_seen(double turned_rad, const Pose& T_table_sensor);
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

  // Of a recording.
  SequenceHeader header_;
  std::optional<double> speed_rad_s_, first_time_s_;
  std::optional<LiveCoverage> seen_;
  /// Of the last frame of each sensor, the table turned back; where that is known.
  std::vector<std::optional<Pose>> T_turned_sensor_;
};

}  // namespace turnscan::studio
