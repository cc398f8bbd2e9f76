#pragma once
// The steps of a reconstruction that commands share: place a recording, and, once its mesh is
// there, say what is known of it. run_reconstruction() and run_scan() are made of them.

#include <turnscan/workflow/reconstruct_run.hpp>

namespace turnscan::workflow {

/// A recording, placed on its table.
struct PlacedRecording {
  std::string name;                         ///< for people; used where there are several
  const FrameSequence* recorded = nullptr;  ///< outlives this
  std::unique_ptr<FrameSequence> on_table;  ///< refers to `recorded`
  CalibratedFrames calibrated;              ///< refer to on_table
};

/// Chooses the calibration. Fails as with_turntable() and calibrate_frames().
Result<PlacedRecording> place_recording(const NamedSequence& recording,
                                        const ReconstructRequest& request,
                                        const RunContext& context);

/// The same for a choice that was made before. Fails as with_turntable() and with_choice().
Result<PlacedRecording> place_recording(const NamedSequence& recording,
                                        const ReconstructRequest& request,
                                        CalibrationChoice choice);

/// Adds to a run whose meshes are there what is said of them: the notes of the calibrations and of
/// the devices, the turn, the choice, the advice for the next pass and, if request.judge, the
/// verdicts. placed: at least one; passes: those that were joined, empty where none were.
/// A step that fails costs nothing but what it would have added: a note says which and why. Fails
/// only with kCancelled.
Result<> conclude_run(const std::vector<PlacedRecording>& placed,
                      const std::vector<PassOfMany>& passes, const ReconstructRequest& request,
                      const RunContext& context, ReconstructRun& run);

}  // namespace turnscan::workflow
