#include <algorithm>
#include <exception>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/workflow/run_steps.hpp>

#include <turnscan/workflow/calibration/calibration_age.hpp>
#include <turnscan/workflow/calibration/disturbed_motion.hpp>
#include <turnscan/workflow/calibration/turntable_file.hpp>
#include <turnscan/workflow/device_notes.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

namespace turnscan::workflow {

namespace {

/// Runs a step after the meshes: an error, or an exception, becomes a note.
template <class Step>
Result<> attempt(const char* what, std::vector<std::string>& notes, const Step& step) {
  const auto note = [&](const std::string& why) {
    notes.push_back(fmt::format("{} could not be made: {}", what, why));
  };
  try {
    const Result<> done = step();
    if (done) return {};
    if (done.error().code == ErrorCode::kCancelled) return done;
    note(done.error().text());
  } catch (const std::exception& error) {
    note(error.what());
  }
  return {};
}

/// Prefixes the recording's name if there are several.
std::string note_of(const PlacedRecording& recording, const std::vector<PlacedRecording>& placed,
                    const std::string& note) {
  return placed.size() == 1 ? note : fmt::format("{}: {}", recording.name, note);
}

/// Inserts the calibrations' notes at the front.
void note_calibrations(const std::vector<PlacedRecording>& placed,
                       std::vector<std::string>& notes) {
  std::vector<std::string> first;
  for (const PlacedRecording& recording : placed) {
    const std::string& note = recording.calibrated.choice.note;
    if (!note.empty()) first.push_back(note_of(recording, placed, note));
  }
  notes.insert(notes.begin(), first.begin(), first.end());
}

/// Adds notes on findings that no verdict names.
void note_findings(const std::vector<PlacedRecording>& placed, bool judged,
                   std::vector<std::string>& notes) {
  for (const PlacedRecording& recording : placed)
    for (const PlausibilityFinding& finding : recording.findings)
      if (!judged || finding.level == Plausibility::kDoubtful)
        notes.push_back(note_of(recording, placed, finding.text));
}

/// Adds notes on what the devices did to depth.
Result<> note_devices(const std::vector<PlacedRecording>& placed, const RunContext& context,
                      std::vector<std::string>& notes) {
  for (const PlacedRecording& recording : placed) {
    TURNSCAN_ASSIGN(const auto said, device_notes(*recording.recorded, context));
    for (const std::string& note : said) notes.push_back(note_of(recording, placed, note));
  }
  return {};
}

/// The frames that an object was made from: of the joined passes, or all of a recording.
std::vector<MeshFrames> frames_of(std::size_t object, const std::vector<PlacedRecording>& placed,
                                  const std::vector<PassOfMany>& passes,
                                  const Reconstruction& made) {
  std::vector<MeshFrames> out;
  for (const FusedPass& fused : made.passes) {
    const auto pass = std::find_if(passes.begin(), passes.end(),
                                   [&](const PassOfMany& p) { return p.name == fused.name; });
    if (pass == passes.end() || (fused.object >= 0 && std::size_t(fused.object) != object))
      continue;
    out.push_back({pass->frames.frames, pass->frames.pass, pass->frames.speed_rad_s,
                   fused.T_object_table, pass->number});
  }
  if (!made.passes.empty()) return out;
  const CalibratedFrames& calibrated = placed[0].calibrated;
  const MergeOptions& merge = calibrated.options.merge;
  const std::optional<std::uint32_t> pass = merge.chosen_pass();
  return {{calibrated.frames.get(), pass, merge.speed_rad_s, Pose::Identity(), pass.value_or(0)}};
}

/// The frames up to the first knock: later ones see the platter elsewhere than the calibration
/// says.
SequenceView before_knock(const FrameSequence& sequence,
                          const std::vector<Disturbance>& disturbances) {
  std::size_t count = sequence.frames().size();
  for (const Disturbance& d : disturbances)
    if (d.kind == DisturbanceKind::kSensor && d.first_frame > 0)
      count = std::min(count, d.first_frame);
  return first_frames(sequence, count);
}

/// Whether the frames stand where the motion of what they show placed them from the beginning, and
/// not where the recorded calibration has them.
bool placed_anew(const CalibrationChoice& choice) {
  return !choice.poses.empty() &&
         std::any_of(choice.disturbances.begin(), choice.disturbances.end(),
                     [](const auto& d) { return d.kind == DisturbanceKind::kCalibration; });
}

/// Judges by the recording that shows most sides of its object.
Result<> judge(const std::vector<PlacedRecording>& placed, const std::vector<PassOfMany>& passes,
               const ReconstructRequest& request, const RunContext& context, ReconstructRun& run) {
  ScanKnowledge known;
  known.choice = &run.choice;
  for (const PlacedRecording& recording : placed) {
    const CalibratedFrames& calibrated = recording.calibrated;
    const auto turn = turn_seen(*calibrated.frames, calibrated.options.merge.speed_rad_s);
    if (turn && (!known.turn || turn->share > known.turn->share)) known.turn = turn;
    known.findings.insert(known.findings.end(), recording.findings.begin(),
                          recording.findings.end());
  }
  const FrameSequence& first = *placed[0].on_table;
  known.dates = dates_of(*placed[0].recorded, request.turntable);
  known.table_recorded = first.header().turntable && !run.choice.calibration && !has_poses(first) &&
                         !placed_anew(run.choice);
  if (known.table_recorded) {
    const SequenceView before = before_knock(first, run.choice.disturbances);
    const bool knocked = before.frames().size() < first.frames().size();
    TURNSCAN_ASSIGN(
        known.platter,
        platter_against_calibration(before, knocked ? std::nullopt : run.choice.platter, context));
  }
  for (PassApart& pass : run.apart) judge_objects(pass.reconstruction, known);
  const Reconstruction& made = run.reconstruction;
  for (std::size_t i = 0; i < made.objects.size(); ++i)
    TURNSCAN_TRY(compare_object(made.objects[i], frames_of(i, placed, passes, made),
                                made.sensor_noise_m, context, known));
  run.frame_residuals = known.residuals;
  known.next_pass = run.next_pass;
  judge_objects(run.reconstruction, known);
  return {};
}

}  // namespace

Error with_cause(Error error, const RecordingFindings& findings) {
  const bool of_data = error.code == ErrorCode::kMissingData ||
                       error.code == ErrorCode::kTooFewPoints || error.code == ErrorCode::kLibrary;
  for (const Plausibility level : {Plausibility::kImplausible, Plausibility::kDoubtful}) {
    for (const auto& of_recording : findings) {
      for (const PlausibilityFinding& finding : of_recording) {
        if (!of_data || finding.level != level) continue;
        error.message = fmt::format("{} ({})", finding.text, error.message);
        return error;
      }
    }
  }
  return error;
}

Result<PlacedRecording> place_recording(const NamedSequence& recording,
                                        const ReconstructRequest& request,
                                        const RunContext& context) {
  PlacedRecording out;
  out.name = recording.name;
  out.recorded = recording.frames;
  TURNSCAN_ASSIGN(out.on_table, with_turntable(*recording.frames, request.turntable));
  TURNSCAN_ASSIGN(out.calibrated,
                  calibrate_frames(*out.on_table, request.calibration, !request.turntable.empty(),
                                   request.options, context));
  out.calibrated.options.keep_points = request.stages.count("merged") > 0;
  return out;
}

Result<PlacedRecording> place_recording(const NamedSequence& recording,
                                        const ReconstructRequest& request,
                                        CalibrationChoice choice) {
  PlacedRecording out;
  out.name = recording.name;
  out.recorded = recording.frames;
  TURNSCAN_ASSIGN(out.on_table, with_turntable(*recording.frames, request.turntable));
  TURNSCAN_ASSIGN(out.calibrated, calibrated_by(*out.on_table, std::move(choice), request.options));
  return out;
}

Result<> conclude_run(const std::vector<PlacedRecording>& placed,
                      const std::vector<PassOfMany>& passes, const ReconstructRequest& request,
                      const RunContext& context, ReconstructRun& run) {
  std::vector<std::string>& notes = run.reconstruction.notes;
  note_calibrations(placed, notes);
  note_findings(placed, request.judge, notes);
  run.choice = placed[0].calibrated.choice;
  const CalibratedFrames& first = placed[0].calibrated;
  run.turn = turn_of(*first.frames);
  if (passes.empty()) {
    const MergeOptions& merge = first.options.merge;
    if (auto views = pass_views(*first.frames, merge.chosen_pass(), merge.speed_rad_s))
      run.seen_from = std::move(*views);
  }
  if (!run.reconstruction.objects.empty())
    TURNSCAN_TRY(attempt("the advice for a next pass", notes, [&]() -> Result<> {
      TURNSCAN_ASSIGN(run.next_pass,
                      advise_next_pass(run.reconstruction.objects[0], run.seen_from, context));
      return {};
    }));
  TURNSCAN_TRY(
      attempt("notes on the device", notes, [&] { return note_devices(placed, context, notes); }));
  if (request.judge)
    TURNSCAN_TRY(attempt("the verdict", notes,
                         [&] { return judge(placed, passes, request, context, run); }));
  return context.check();
}

}  // namespace turnscan::workflow
