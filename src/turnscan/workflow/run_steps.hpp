#pragma once
// Steps of a reconstruction shared by commands: choosing the calibration of a recording and, once
// its mesh exists, evaluating it. run_reconstruction() and run_scan() consist of them.

#include <turnscan/recording/plausibility/plausibility.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>

namespace turnscan::workflow {

/// A recording with calibrated poses on its table.
struct PlacedRecording {
  std::string name;                                ///< human-readable; used if there are several
  const FrameSequence* recorded = nullptr;         ///< must outlive this
  std::unique_ptr<FrameSequence> on_table;         ///< refers to `recorded`
  CalibratedFrames calibrated;                     ///< refers to on_table
  std::vector<PlausibilityFinding> findings = {};  ///< see find_implausible()
};

/// Of each recording; see find_implausible().
using RecordingFindings = std::vector<std::vector<PlausibilityFinding>>;

/// The error of work on data, with what cannot be in them, or hardly, as its cause.
Error with_cause(Error error, const RecordingFindings& findings);

/// Chooses the calibration. Fails as with_turntable() and calibrate_frames().
Result<PlacedRecording> place_recording(const NamedSequence& recording,
                                        const ReconstructRequest& request,
                                        const RunContext& context);

/// The same for an existing choice. Fails as with_turntable() and with_choice().
Result<PlacedRecording> place_recording(const NamedSequence& recording,
                                        const ReconstructRequest& request,
                                        CalibrationChoice choice);

/// Adds to a run with meshes all that is derived from them: the notes of the calibrations, of the
/// findings and of the devices, the turn, the choice, the advice for the next pass and, if
/// request.judge, the verdicts. placed: at least one; passes: those that were joined, empty if none
/// were. A failing step only loses its own result: a note says which and why. Fails only with
/// kCancelled.
Result<> conclude_run(const std::vector<PlacedRecording>& placed,
                      const std::vector<PassOfMany>& passes, const ReconstructRequest& request,
                      const RunContext& context, ReconstructRun& run);

}  // namespace turnscan::workflow
