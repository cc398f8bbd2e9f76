#pragma once
// From a turning table to a mesh in one go: finds the table, waits for an object, records it,
// reconstructs meanwhile or afterwards, and writes mesh and report. Optionally repeats this for
// further passes with the object in another pose, and fuses all passes into one mesh.

#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <vector>

namespace turnscan {

/// Processing during the recording (see ScanAhead).
struct AheadOptions {
  /// Share of the recording at which processing begins; nullopt: at its end.
  std::optional<double> share = 0.8;
};
/// Option `ahead`.
OptionTable describe(AheadOptions& options);

struct ScanRequest {
  /// With devices; its speed is that of reconstruct.merge. With options.resume, `recording` names
  /// the recording to go on with.
  CaptureSetup setup;
  ReconstructOptions reconstruct;
  AheadOptions ahead;
  std::string mesh;  ///< see write_objects()
  WriteMeshOptions mesh_options;
  std::string recording;  ///< folder to create; empty: an unused name next to the mesh
  std::string report;     ///< .json; empty: none
  std::string page;       ///< .html, see make_page(); empty: none
  /// Number of passes; nullopt: asks ScanHooks::another_side after each.
  std::optional<int> passes;
  /// .png, replaced after each pass; see next_pass_picture(). Empty: none.
  std::string advice_picture;
  bool wait = true;         ///< until an object is on the platter, if that can be detected
  bool allow_open = false;  ///< accept a mesh that is not watertight
  bool overwrite_unfinished = false;  ///< remove an existing unfinished recording
};

/// The folder to create: if not given, "dir/doll.3mf" -> "dir/doll.recording", or the next unused
/// "dir/doll-2.recording". With overwrite_unfinished an unfinished recording counts as unused.
std::string recording_of(const ScanRequest& request);

/// Called from the scanning thread.
struct ScanHooks {
  std::function<void(const CaptureProgress&)> progress;
  std::function<void()> recorded;  ///< a pass has been recorded
  /// Called before a further pass if the user has to reposition the object, or to decide whether
  /// there is another pass. Everything scanned so far is on disk. True: the object has been
  /// repositioned; false: no further pass. Empty: there is no user to ask.
  std::function<Result<bool>(const std::string& advice, std::uint32_t pass)> another_side;
  std::function<void(const CaptureSetup&)> begin = {};  ///< a pass will be recorded
  std::function<void(const Frame&)> frame = {};         ///< each frame as it is recorded
};

struct ScanOutcome {
  std::string recording;
  std::vector<CaptureResult> captured;          ///< one per pass
  ReconstructRun run;                           ///< of all passes so far
  std::vector<std::string> notes;               ///< sentences for the user
  double after_s = 0.0, processor_after_s = 0;  ///< from the last frame to the mesh
  std::vector<std::string> files;               ///< all files written except the recording

  struct Ahead {
    std::size_t frames = 0;
    bool kept = false;
    double closure_m = 0.0, closure_limit_m = 0.0;
  };
  std::optional<Ahead> ahead;  ///< see ScanAhead::Outcome
};

/// Phases of the context: "record" has 1000 steps, which the caller advances. If the table's pose
/// and speed are known beforehand, frames are reconstructed as they arrive, and again from the
/// recording if the choice of calibration (choose_calibration(), "auto") changes their poses; if
/// nothing is known, ScanAhead does what it can; otherwise everything is done after the last frame.
/// Thus run_reconstruction() of the recording gives the same meshes, notes and verdicts, except for
/// what ScanAhead kept. A calibration found from motion is stored for the device.
/// After each pass the files are written. For a further pass the source itself repositions the
/// object if it can (FrameSource::lay_object(), as advised); the pass is appended to the recording,
/// from which all passes are then reconstructed as by run_reconstruction(). A pass that does not
/// fit is not an error here; check_joined() reports it.
/// Fails with kInvalidOption and as check_output_file() if an output cannot be written, as
/// CaptureSetup::open(), capture(), capture_outcome(), reconstruct() and check_watertight(), as the
/// hook another_side does, and with kCancelled; also with kInvalidOption if more than one pass is
/// requested but the object cannot be repositioned. The recording is kept, and errors after it say
/// where it is.
Result<ScanOutcome> run_scan(ScanRequest request, const ScanHooks& hooks,
                             const RunContext& context);

/// What was recorded and reconstructed, notes and times, human-readable.
std::string scan_text(const ScanOutcome& outcome);

}  // namespace turnscan
