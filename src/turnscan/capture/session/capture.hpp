#pragma once
// Records frames of a source: for a number of turns, for some time, or until it is stopped.

#include <filesystem>
#include <functional>
#include <memory>
#include <turnscan/capture/motor/motor.hpp>
#include <turnscan/capture/recorder/recorder.hpp>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan {

/// End of a recording. At most one of turns, seconds and frames; none of them: after one turn.
struct CaptureLimits {
  std::optional<double> turns;
  std::optional<double> seconds;  ///< sensor time
  std::optional<int> frames;      ///< per sensor
  bool until_stopped = false;
  double overlap_rad = 0.069813170;  ///< added to the turns, so that the first view is seen again
  /// Time without a frame after which the device is considered lost.
  double device_timeout_s = 10.0;
};
/// Options turns, seconds, frames, until-stopped, overlap, device-timeout.
OptionTable describe(CaptureLimits& limits);

/// The part of a frame that is recorded.
struct CaptureCrop {
  bool enabled = false;
  /// Below the platter, to keep the returns of the platter itself, which later stages measure.
  double below_m = 0.02;
  double beyond_m = 0.03;  ///< beyond the platter's rim
  double height_m = 0.6;   ///< above the platter
};
/// Options crop, crop-below, crop-beyond, crop-height.
OptionTable describe(CaptureCrop& crop);

/// Stop-and-go operation with a motor: the table stands still while frames are taken, and their
/// mean is recorded.
struct CaptureStops {
  std::optional<int> stops;  ///< per turn; nullopt: the table turns continuously
  int averaged = 5;          ///< frames at each stop, averaged into one frame of the recording
  double settle_s = 0.3;     ///< time to settle before the frames are taken
};
/// Options stops, stop-frames, settle.
OptionTable describe(CaptureStops& stops);

struct CaptureOptions {
  CaptureLimits limits;
  CaptureCrop crop;
  CaptureStops stops;
  RecorderOptions recorder;
  std::optional<double> speed_rad_s;  ///< known speed of the table, or speed for the motor
  double motor_ramp_s = 1.5;          ///< time for the motor to reach its speed
  /// The folder contains a complete recording: the object is in another pose, and its frames become
  /// the next pass.
  bool add_pass = false;
  /// The folder contains a recording that was ended early, with which the capture goes on. A source
  /// that is not live gives its frames again; those that are recorded are passed over. At stops of
  /// a live one the next stop follows; a table that turns steadily begins a new stretch
  /// (FrameInfo::stretch), for which the limits hold anew.
  bool resume = false;
};

struct CaptureProgress {
  std::uint64_t frames = 0;          ///< recorded
  std::uint64_t dropped = 0;         ///< by sensor, queue and disk
  std::optional<double> turned_rad;  ///< nullopt: not known yet
  double seconds = 0.0;              ///< sensor time
  std::uint64_t free_bytes = 0;
  double fraction = 0.0;  ///< of what the limits request; 0 if not known
  /// The motion estimated so far if the turns are counted by the object's motion, which is
  /// estimated again after half a turn; else nullptr.
  std::shared_ptr<const Calibration> motion;
};

struct CaptureHooks {
  std::function<void(const CaptureProgress&)> progress;
  /// Called for each frame as it is recorded. A failure ends the recording and becomes capture's
  /// error.
  std::function<Result<>(const Frame&)> frame;
  Motor* motor = nullptr;  ///< turned at speed_rad_s, or from stop to stop
};

struct CaptureResult {
  std::string ended;           ///< reason, human-readable: "after 1.01 turns"
  std::optional<Error> error;  ///< what ended it early; includes kCancelled
  bool recorded = false;       ///< the recording exists
  bool complete = false;  ///< and is marked complete; false if the disk had no space even for that
  RecorderStatistics recorder;
  SourceStatistics source;
  double seconds = 0.0;
  double longest_gap_s = 0.0;  ///< between two frames, by this machine's clock
  std::optional<double> turned_rad;
  std::string turns_found;  ///< how the turns were counted, human-readable
  std::optional<double> speed_rad_s;
  double cpu_s = 0.0;  ///< processor time of the whole process during the capture
};

/// Takes frames from a started source and records them into a folder that does not exist or is
/// empty; frame 0 is the first to arrive. header and settings go into recording.json; frames can be
/// cropped if header.turntable and its pose are set. However the recording ends, it is completed
/// with all frames so far. Nothing is created if no frame arrives. With add_pass the recording's
/// own header and settings are kept, and angles start anew; with resume they are kept, too, after
/// repair_recording(). Fails, without having recorded
/// anything, with kInvalidOption (contradictory limits, crop without a turntable, a pass of other
/// sensors; a recording to resume that is finished, of another device or with other stops), as
/// Recorder::create() does, and to add a pass or resume as Recording::open(), repair_recording()
/// and Recorder::extend() do.
Result<CaptureResult> capture(FrameSource& source, const std::filesystem::path& folder,
                              const SequenceHeader& header, const CaptureSettings& settings,
                              const CaptureOptions& options, const CaptureHooks& hooks,
                              const RunContext& context);

/// Mean of images of the same size: per pixel over the frames with a return there; a pixel with
/// returns in less than half of them has none. Colour is that of the last frame.
Frame mean_frame(const std::vector<Frame>& frames);

}  // namespace turnscan
