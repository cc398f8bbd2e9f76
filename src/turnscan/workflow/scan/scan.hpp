#pragma once
// From a turning table to a mesh in one go: finds the table, waits for an object, records it,
// reconstructs meanwhile or afterwards, and writes mesh and report.

#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <vector>

namespace turnscan {

/// Work while frames come (see ScanAhead).
struct AheadOptions {
  std::optional<double> share = 0.8;  ///< of the recording, at which it begins; nullopt: at its end
};
/// Field ahead.
OptionTable describe(AheadOptions& options);

struct ScanRequest {
  CaptureSetup setup;  ///< with devices; its speed is that of reconstruct.merge
  ReconstructOptions reconstruct;
  AheadOptions ahead;
  std::string mesh;         ///< see write_objects()
  std::string recording;    ///< folder to make; empty: a free name beside the mesh
  std::string report;       ///< .json; empty: none
  bool wait = true;         ///< until something stands on the platter, where that can be seen
  bool allow_open = false;  ///< a mesh that is not watertight is no failure
  bool overwrite_unfinished = false;  ///< an unfinished recording there is removed
};

/// The folder that it is to make: "dir/doll.3mf" -> "dir/doll.recording", or the next free
/// "dir/doll-2.recording", where it is not given. With overwrite_unfinished one that is unfinished
/// counts as free.
std::string recording_of(const ScanRequest& request);

/// Called from the thread that records.
struct ScanHooks {
  std::function<void(const CaptureProgress&)> progress;
  std::function<void()> recorded;  ///< the recording has ended
};

struct ScanOutcome {
  std::string recording;
  CaptureResult captured;
  Reconstruction reconstruction;
  std::vector<std::string> notes;               ///< sentences for people
  double after_s = 0.0, processor_after_s = 0;  ///< from the last frame to the mesh
  std::vector<std::string> files;               ///< that were written, but the recording
};

/// Phases of the context: "record" has 1000 steps, which are the caller's to advance. Where the
/// table's place and speed are known before, frames are reconstructed as they come; where nothing
/// is known, ScanAhead does what it can; else all is done after the last frame. A calibration found
/// from motion is kept for the device.
/// Fails with kInvalidOption and as check_output_file() where an output cannot be written, as
/// CaptureSetup::open(), capture(), capture_outcome(), reconstruct() and check_watertight(), and
/// with kCancelled. The recording stays, and errors after it say where it is.
Result<ScanOutcome> run_scan(ScanRequest request, const ScanHooks& hooks,
                             const RunContext& context);

/// What was recorded and reconstructed, notes and times, for people.
std::string scan_text(const ScanOutcome& outcome);

}  // namespace turnscan
