#include <algorithm>
#include <turnscan/reconstruction/report.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>

#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include <turnscan/workflow/calibration/turntable_file.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan {

Result<CalibratedFrames> calibrate_frames(const FrameSequence& sequence, const std::string& mode,
                                          bool table_given, const ReconstructOptions& options,
                                          const RunContext& context) {
  CalibratedFrames out;
  TURNSCAN_ASSIGN(
      out.choice,
      choose_calibration(sequence, {mode, options.merge.speed_rad_s, table_given}, context));
  TURNSCAN_ASSIGN(out.frames, with_choice(sequence, out.choice));
  out.options = options;
  if (out.choice.calibration) out.options.merge.speed_rad_s.reset();  // it is in the angles
  return out;
}

namespace {

/// A recording, placed on its table.
struct PlacedRecording {
  std::unique_ptr<FrameSequence> on_table;
  CalibratedFrames calibrated;  // refer to it
};

Result<PlacedRecording> place_recording(const FrameSequence& sequence,
                                        const ReconstructRequest& request,
                                        const RunContext& context) {
  PlacedRecording out;
  TURNSCAN_ASSIGN(out.on_table, with_turntable(sequence, request.turntable));
  TURNSCAN_ASSIGN(out.calibrated,
                  calibrate_frames(*out.on_table, request.calibration, !request.turntable.empty(),
                                   request.options, context));
  out.calibrated.options.keep_points = request.stages.count("merged") > 0;
  return out;
}

/// Whether the recordings hold several passes that are to become one mesh. Poses of their own bring
/// frames together as they are.
bool joins_passes(const std::vector<NamedSequence>& recordings, const ReconstructRequest& request) {
  if (recordings.size() > 1 || !request.pass_poses.empty()) return true;
  const FrameSequence& frames = *recordings[0].frames;
  return !request.options.merge.pass && passes_of(frames).size() > 1 &&
         !std::all_of(frames.frames().begin(), frames.frames().end(),
                      [](const FrameInfo& f) { return f.T_table_sensor.has_value(); });
}

Result<> check_join(const std::vector<PassOfMany>& passes, const ReconstructRequest& request) {
  if (request.options.merge.pass)
    return fail(ErrorCode::kInvalidOption,
                "--pass takes one pass of one recording; without it all are joined");
  if (passes.size() < 2)
    return fail(ErrorCode::kInvalidOption,
                "there is but one pass, and nothing to join it with; leave --pass-pose out");
  return {};
}

Result<> reconstruct_joined(const std::vector<NamedSequence>& recordings,
                            const std::vector<PlacedRecording>& placed,
                            const ReconstructRequest& request, const StageSink& sink,
                            const RunContext& context, ReconstructRun& run) {
  std::vector<RecordingFrames> frames;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    frames.push_back({recordings[i].name, placed[i].calibrated.frames.get(),
                      placed[i].calibrated.options.merge.speed_rad_s});
  TURNSCAN_ASSIGN(const auto passes, list_passes(frames, request.pass_poses));
  TURNSCAN_TRY(check_join(passes, request));
  TURNSCAN_ASSIGN(JoinedRun joined,
                  join_and_reconstruct(passes, placed[0].calibrated.options, sink, context));
  run.reconstruction = std::move(joined.reconstruction);
  run.apart = std::move(joined.apart);
  return {};
}

/// What the calibrations have to say comes first.
void note_calibrations(const std::vector<NamedSequence>& recordings,
                       const std::vector<PlacedRecording>& placed,
                       std::vector<std::string>& notes) {
  std::vector<std::string> first;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::string& note = placed[i].calibrated.choice.note;
    if (!note.empty())
      first.push_back(placed.size() == 1 ? note : fmt::format("{}: {}", recordings[i].name, note));
  }
  notes.insert(notes.begin(), first.begin(), first.end());
}

Result<> check_meshes(const ReconstructRun& run) {
  TURNSCAN_TRY(check_watertight(run.reconstruction));
  for (const PassApart& pass : run.apart) TURNSCAN_TRY(check_watertight(pass.reconstruction));
  return {};
}

}  // namespace

Result<ReconstructRun> run_reconstruction(const FrameSequence& sequence,
                                          const ReconstructRequest& request,
                                          const RunContext& context) {
  return run_reconstruction(std::vector<NamedSequence>{{"", &sequence}}, request, context);
}

Result<ReconstructRun> run_reconstruction(const std::vector<NamedSequence>& recordings,
                                          const ReconstructRequest& request,
                                          const RunContext& context) {
  std::vector<PlacedRecording> placed;
  for (const NamedSequence& recording : recordings) {
    TURNSCAN_ASSIGN(PlacedRecording one, place_recording(*recording.frames, request, context));
    placed.push_back(std::move(one));
  }
  ReconstructRun run;
  const StageSink sink = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
    if (request.stages.count(stage) > 0) run.stages[stage] = cloud;
    return {};
  };
  if (joins_passes(recordings, request)) {
    TURNSCAN_TRY(reconstruct_joined(recordings, placed, request, sink, context, run));
  } else {
    const CalibratedFrames& calibrated = placed[0].calibrated;
    TURNSCAN_ASSIGN(run.reconstruction,
                    reconstruct(*calibrated.frames, calibrated.options, sink, context));
  }
  note_calibrations(recordings, placed, run.reconstruction.notes);
  run.choice = std::move(placed[0].calibrated.choice);
  if (!request.allow_open) TURNSCAN_TRY(check_meshes(run));
  TURNSCAN_TRY(context.check());
  return run;
}

Result<> check_joined(const ReconstructRun& run) {
  std::vector<std::string> reasons;
  for (const PassApart& pass : run.apart)
    if (!pass.reason.empty())
      reasons.push_back(fmt::format("{} was not joined: {}", pass.name, pass.reason));
  if (reasons.empty()) return {};
  return fail(ErrorCode::kMissingData,
              "{}; its own mesh was written beside, --pass-pose says where a pass lies",
              fmt::join(reasons, "; "));
}

Result<> check_outputs(const ReconstructFiles& files) {
  TURNSCAN_TRY(check_mesh_file(files.mesh));
  TURNSCAN_TRY(check_output_file(files.report, ".json"));
  for (const auto& [stage, file] : files.stages) TURNSCAN_TRY(check_output_file(file, ".ply"));
  return {};
}

Result<std::vector<std::string>> write_outputs(const ReconstructFiles& files,
                                               const ReconstructRun& run,
                                               const ReconstructOptions& options) {
  std::vector<std::string> written;
  if (run.apart.empty() || !run.reconstruction.objects.empty()) {
    TURNSCAN_ASSIGN(written, write_objects(files.mesh, run.reconstruction));
  }
  for (const PassApart& pass : run.apart) {
    if (pass.reconstruction.objects.empty()) continue;
    const std::string file = with_suffix(files.mesh, fmt::format("-pass{}", pass.number));
    TURNSCAN_ASSIGN(const auto own, write_objects(file, pass.reconstruction));
    written.insert(written.end(), own.begin(), own.end());
  }
  for (const auto& [stage, file] : files.stages) {
    const auto cloud = run.stages.find(stage);
    if (file.empty() || cloud == run.stages.end()) continue;
    TURNSCAN_TRY(write_cloud(file, cloud->second));
    written.push_back(file);
  }
  if (!files.report.empty()) {
    TURNSCAN_TRY(write_file_atomically(files.report, report_json(run.reconstruction, options)));
    written.push_back(files.report);
  }
  return written;
}

}  // namespace turnscan
