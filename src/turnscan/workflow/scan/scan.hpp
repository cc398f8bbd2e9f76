#pragma once
// From a turning table to a mesh in one go: finds the table, waits for an object, records it,
// reconstructs meanwhile or afterwards, and writes mesh and report. Then, if wanted, the same for
// further passes, in which the object lies another way, until one mesh has all of it.

#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
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
  std::string mesh;  ///< see write_objects()
  WriteMeshOptions mesh_options;
  std::string recording;  ///< folder to make; empty: a free name beside the mesh
  std::string report;     ///< .json; empty: none
  std::string page;       ///< .html, see make_page(); empty: none
  /// Of the object's passes; nullopt: asks ScanHooks::another_side after each.
  std::optional<int> passes;
  std::string advice_picture;  ///< .png, new after each pass; see next_pass_picture(). Empty: none
  bool wait = true;            ///< until something stands on the platter, where that can be seen
  bool allow_open = false;     ///< a mesh that is not watertight is no failure
  bool overwrite_unfinished = false;  ///< an unfinished recording there is removed
};

/// The folder that it is to make: "dir/doll.3mf" -> "dir/doll.recording", or the next free
/// "dir/doll-2.recording", where it is not given. With overwrite_unfinished one that is unfinished
/// counts as free.
std::string recording_of(const ScanRequest& request);

/// Called from the thread that scans.
struct ScanHooks {
  std::function<void(const CaptureProgress&)> progress;
  std::function<void()> recorded;  ///< a pass has been recorded
  /// Before a further pass, where somebody has to lay the object another way, or to say whether
  /// there is to be one. All that was scanned so far is on the disk. True: it lies so now; false:
  /// there is no further pass. Empty: nobody can be asked.
  std::function<Result<bool>(const std::string& advice, std::uint32_t pass)> another_side;
};

struct ScanOutcome {
  std::string recording;
  std::vector<CaptureResult> captured;          ///< of each pass
  ReconstructRun run;                           ///< of all passes so far
  std::vector<std::string> notes;               ///< sentences for people
  double after_s = 0.0, processor_after_s = 0;  ///< from the last frame to the mesh
  std::vector<std::string> files;               ///< that were written, but the recording

  struct Ahead {
    std::size_t frames = 0;
    bool kept = false;
    double closure_m = 0.0, closure_limit_m = 0.0;
  };
  std::optional<Ahead> ahead;  ///< see ScanAhead::Outcome
};

/// Phases of the context: "record" has 1000 steps, which are the caller's to advance. Where the
/// table's place and speed are known before, frames are reconstructed as they come, and again from
/// the recording where the choice of calibration (choose_calibration(), "auto") then places them
/// elsewhere; where nothing is known, ScanAhead does what it can; else all is done after the last
/// frame. So, but for what ScanAhead kept, run_reconstruction() of the recording makes the same
/// meshes, notes and verdicts. A calibration found from motion is kept for the device.
/// After each pass the files are written. A further pass is laid by the source itself where it can
/// (FrameSource::lay_object(), as is advised); it is added to the recording, from which all passes
/// are then reconstructed as by run_reconstruction(). A pass that does not fit is no failure here;
/// check_joined() tells it.
/// Fails with kInvalidOption and as check_output_file() where an output cannot be written, as
/// CaptureSetup::open(), capture(), capture_outcome(), reconstruct() and check_watertight(), as
/// the hook another_side does, and with kCancelled; with kInvalidOption, too, when more than one
/// pass is asked for where the object cannot be laid another way. The recording stays, and errors
/// after it say where it is.
Result<ScanOutcome> run_scan(ScanRequest request, const ScanHooks& hooks,
                             const RunContext& context);

/// What was recorded and reconstructed, notes and times, for people.
std::string scan_text(const ScanOutcome& outcome);

}  // namespace turnscan
