#pragma once
// Records what a source of frames sees: for some turns, for some time, or until it is stopped.

#include <filesystem>
#include <functional>
#include <memory>
#include <turnscan/capture/motor/motor.hpp>
#include <turnscan/capture/recorder/recorder.hpp>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan {

/// When a recording ends. At most one of turns, seconds and frames; none of them: after one turn.
struct CaptureLimits {
  std::optional<double> turns;
  std::optional<double> seconds;  ///< of the sensor's time
  std::optional<int> frames;      ///< of each sensor
  bool until_stopped = false;
  double overlap_rad = 0.069813170;  ///< added to turns: the first view is seen once more
  double device_timeout_s = 10.0;    ///< without a frame, after which the device counts as lost
};
/// Fields turns, seconds, frames, until-stopped, overlap, device-timeout.
OptionTable describe(CaptureLimits& limits);

/// What is recorded of a frame.
struct CaptureCrop {
  bool enabled = false;
  /// Below the platter, so that its own returns stay: later stages measure them.
  double below_m = 0.02;
  double beyond_m = 0.03;  ///< outside the platter's rim
  double height_m = 0.6;   ///< above the platter
};
/// Fields crop, crop-below, crop-beyond, crop-height.
OptionTable describe(CaptureCrop& crop);

/// Stop and go with a motor: the table stands while frames are taken, and their mean is recorded.
struct CaptureStops {
  std::optional<int> stops;  ///< in one turn; none: the table turns steadily
  int averaged = 5;          ///< frames at each stop, whose mean is one frame of the recording
  double settle_s = 0.3;     ///< that the table stands before
};
/// Fields stops, stop-frames, settle.
OptionTable describe(CaptureStops& stops);

struct CaptureOptions {
  CaptureLimits limits;
  CaptureCrop crop;
  CaptureStops stops;
  RecorderOptions recorder;
  std::optional<double> speed_rad_s;  ///< known speed of the table, or the motor's
  double motor_ramp_s = 1.5;          ///< that the motor gets to reach its speed
  /// The folder holds a recording that is complete: the object lies another way, and its frames
  /// become the next pass.
  bool add_pass = false;
};

struct CaptureProgress {
  std::uint64_t frames = 0;          ///< recorded
  std::uint64_t dropped = 0;         ///< by sensor, queue and disk
  std::optional<double> turned_rad;  ///< nullopt: not known yet
  double seconds = 0.0;              ///< of the sensor's time
  std::uint64_t free_bytes = 0;
  double fraction = 0.0;  ///< of what the limits ask for; 0 where that is not known
  /// Where the turns are counted by the object's motion, what that has shown so far; it is found
  /// once more after half a turn. Else nullptr.
  std::shared_ptr<const Calibration> motion;
};

struct CaptureHooks {
  std::function<void(const CaptureProgress&)> progress;
  /// Each frame as it is recorded. A failure ends the recording, and is capture's error.
  std::function<Result<>(const Frame&)> frame;
  Motor* motor = nullptr;  ///< turned at speed_rad_s, or from stop to stop
};

struct CaptureResult {
  std::string ended;           ///< why, for people: "after 1.01 turns"
  std::optional<Error> error;  ///< what ended it too early; kCancelled, too
  bool recorded = false;       ///< the recording exists
  bool complete = false;       ///< and is marked so; not where the disk had no room even for that
  RecorderStatistics recorder;
  SourceStatistics source;
  double seconds = 0.0;
  double longest_gap_s = 0.0;  ///< between two frames, on this machine's clock
  std::optional<double> turned_rad;
  std::string turns_found;  ///< how, for people
  std::optional<double> speed_rad_s;
  double cpu_s = 0.0;  ///< processor time of the whole process meanwhile
};

/// Takes frames from a source that was started and records them into a folder that does not exist
/// or is empty; frame 0 is the first that comes. header and settings go into recording.json; with
/// header.turntable and its pose frames can be cropped. Whatever ends the recording, it is
/// finished: what came before is there. Nothing is made when no frame came. With add_pass the
/// recording's own header and settings stay, and angles begin anew. Fails, without having recorded
/// anything, with kInvalidOption (limits that contradict each other, crop without a turntable, a
/// pass of other sensors), as Recorder::create() does, and to add a pass as Recording::open() and
/// Recorder::extend() do.
Result<CaptureResult> capture(FrameSource& source, const std::filesystem::path& folder,
                              const SequenceHeader& header, const CaptureSettings& settings,
                              const CaptureOptions& options, const CaptureHooks& hooks,
                              const RunContext& context);

/// The mean of images of one size, pixel by pixel over the frames with a return there; a pixel with
/// returns in less than half of them has none. Colour is the last frame's.
Frame mean_frame(const std::vector<Frame>& frames);

}  // namespace turnscan
