#include <algorithm>
#include <nlohmann/json.hpp>
#include <turnscan/reconstruction/report.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>

#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/recording/calibration_file.hpp>

#include <turnscan/workflow/calibration/disturbed_motion.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/next_pass/next_pass_json.hpp>
#include <turnscan/workflow/next_pass/next_pass_picture.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/run_steps.hpp>
#include <turnscan/workflow/verdict/residuals_json.hpp>

namespace turnscan {

Result<CalibratedFrames> calibrated_by(const FrameSequence& sequence, CalibrationChoice choice,
                                       const ReconstructOptions& options) {
  CalibratedFrames out;
  out.choice = std::move(choice);
  TURNSCAN_ASSIGN(out.frames, with_choice(sequence, out.choice));
  out.options = options;
  if (out.choice.calibration) out.options.merge.speed_rad_s.reset();  // included in the angles
  return out;
}

Result<CalibratedFrames> calibrate_frames(const FrameSequence& sequence, const std::string& mode,
                                          bool table_given, const ReconstructOptions& options,
                                          const RunContext& context) {
  TURNSCAN_ASSIGN(
      CalibrationChoice choice,
      choose_calibration(sequence, {mode, options.merge.speed_rad_s, table_given}, context));
  return calibrated_by(sequence, std::move(choice), options);
}

namespace {

using workflow::PlacedRecording;
using workflow::RecordingFindings;

/// Whether the recordings have several passes to be fused into one mesh. Frames with poses of their
/// own are fused as they are.
bool joins_passes(const std::vector<NamedSequence>& recordings, const ReconstructRequest& request) {
  if (recordings.size() > 1 || !request.pass_poses.empty()) return true;
  const FrameSequence& frames = *recordings[0].frames;
  return !request.options.merge.pass && passes_of(frames).size() > 1 &&
         (frames.header().poses_within_pass || !workflow::has_poses(frames));
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

Result<> reconstruct_joined(const std::vector<PlacedRecording>& placed,
                            const ReconstructRequest& request, const StageSink& sink,
                            const RunContext& context, std::vector<PassOfMany>& passes,
                            ReconstructRun& run) {
  std::vector<RecordingFrames> frames;
  for (const PlacedRecording& one : placed)
    frames.push_back(
        {one.name, one.calibrated.frames.get(), one.calibrated.options.merge.speed_rad_s});
  TURNSCAN_ASSIGN(passes, list_passes(frames, request.pass_poses));
  TURNSCAN_TRY(check_join(passes, request));
  TURNSCAN_ASSIGN(JoinedRun joined,
                  join_and_reconstruct(passes, placed[0].calibrated.options, sink, context));
  run.reconstruction = std::move(joined.reconstruction);
  run.apart = std::move(joined.apart);
  const auto& fused = run.reconstruction.passes;
  const auto of_largest =
      std::find_if(fused.rbegin(), fused.rend(), [](const FusedPass& p) { return p.object <= 0; });
  if (of_largest == fused.rend()) return {};
  const FusedPass& last = *of_largest;
  const auto pass = std::find_if(passes.begin(), passes.end(),
                                 [&](const PassOfMany& p) { return p.name == last.name; });
  if (pass == passes.end()) return {};
  const auto views = pass_views(*pass->frames.frames, pass->frames.pass, pass->frames.speed_rad_s);
  if (!views) return {};
  run.seen_from = *views;
  run.seen_from.name = last.name;
  run.seen_from.T_mesh_table = last.T_object_table;
  return {};
}

Result<> check_meshes(const ReconstructRun& run) {
  TURNSCAN_TRY(check_watertight(run.reconstruction));
  for (const PassApart& pass : run.apart) TURNSCAN_TRY(check_watertight(pass.reconstruction));
  return {};
}

Result<ReconstructRun> reconstruct_recordings(const std::vector<NamedSequence>& recordings,
                                              const RecordingFindings& findings,
                                              const ReconstructRequest& request,
                                              const RunContext& context,
                                              const MeshSink& write_meshes) {
  std::vector<PlacedRecording> placed;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    TURNSCAN_ASSIGN(PlacedRecording one,
                    workflow::place_recording(recordings[i], request, context));
    one.findings = findings[i];
    placed.push_back(std::move(one));
  }
  ReconstructRun run;
  const StageSink sink = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
    if (request.stages.count(stage) > 0) run.stages[stage] = cloud;
    return {};
  };
  std::vector<PassOfMany> passes;
  if (joins_passes(recordings, request)) {
    TURNSCAN_TRY(reconstruct_joined(placed, request, sink, context, passes, run));
  } else {
    const CalibratedFrames& calibrated = placed[0].calibrated;
    TURNSCAN_ASSIGN(run.reconstruction,
                    reconstruct(*calibrated.frames, calibrated.options, sink, context));
  }
  if (!request.allow_open) TURNSCAN_TRY(check_meshes(run));
  if (write_meshes) TURNSCAN_TRY(write_meshes(run));
  TURNSCAN_TRY(workflow::conclude_run(placed, passes, request, context, run));
  return run;
}

}  // namespace

Result<ReconstructRun> run_reconstruction(const FrameSequence& sequence,
                                          const ReconstructRequest& request,
                                          const RunContext& context, const MeshSink& write_meshes) {
  return run_reconstruction(std::vector<NamedSequence>{{"", &sequence}}, request, context,
                            write_meshes);
}

Result<ReconstructRun> run_reconstruction(const std::vector<NamedSequence>& recordings,
                                          const ReconstructRequest& request,
                                          const RunContext& context, const MeshSink& write_meshes) {
  RecordingFindings findings;
  for (const NamedSequence& recording : recordings) {
    TURNSCAN_ASSIGN(auto found, find_implausible(*recording.frames, context));
    findings.push_back(std::move(found));
  }
  auto run = reconstruct_recordings(recordings, findings, request, context, write_meshes);
  if (!run) return tl::unexpected<Error>(workflow::with_cause(std::move(run).error(), findings));
  return run;
}

Result<> check_joined(const std::vector<PassApart>& apart) {
  std::vector<std::string> reasons;
  for (const PassApart& pass : apart)
    if (!pass.reason.empty())
      reasons.push_back(fmt::format("{} was not joined: {}", pass.name, pass.reason));
  if (reasons.empty()) return {};
  return fail(ErrorCode::kMissingData,
              "{}; its own mesh was written beside, --pass-pose says where a pass lies",
              fmt::join(reasons, "; "));
}

Result<> check_outputs(const ReconstructFiles& files) {
  TURNSCAN_TRY(check_mesh_file(files.mesh, files.mesh_options));
  TURNSCAN_TRY(check_report_files({files.report, files.page}));
  for (const auto& [stage, file] : files.stages) TURNSCAN_TRY(check_output_file(file, ".ply"));
  return check_output_file(files.advice_picture, ".png");
}

std::string mesh_of_pass(const std::string& mesh, std::uint32_t pass) {
  return with_suffix(mesh, fmt::format("-pass{}", pass));
}

Result<std::vector<std::string>> write_run_meshes(const ReconstructFiles& files,
                                                  const ReconstructRun& run) {
  std::vector<std::string> written;
  if (run.apart.empty() || !run.reconstruction.objects.empty()) {
    TURNSCAN_ASSIGN(written, write_objects(files.mesh, run.reconstruction, files.mesh_options));
  }
  for (const PassApart& pass : run.apart) {
    if (pass.reconstruction.objects.empty()) continue;
    TURNSCAN_ASSIGN(const auto own, write_objects(mesh_of_pass(files.mesh, pass.number),
                                                  pass.reconstruction, files.mesh_options));
    written.insert(written.end(), own.begin(), own.end());
  }
  return written;
}

Result<std::vector<std::string>> write_beside(const ReconstructFiles& files,
                                              const ReconstructRun& run, const std::string& report,
                                              const RunContext& context) {
  std::vector<std::string> written;
  for (const auto& [stage, file] : files.stages) {
    const auto cloud = run.stages.find(stage);
    if (file.empty() || cloud == run.stages.end()) continue;
    TURNSCAN_TRY(write_cloud(file, cloud->second));
    written.push_back(file);
  }
  if (!files.advice_picture.empty() && run.next_pass) {
    TURNSCAN_ASSIGN(const ColorImage picture,
                    next_pass_picture(run.reconstruction.objects[0], run.seen_from, *run.next_pass,
                                      RunContext()));
    TURNSCAN_TRY(write_color_png(files.advice_picture, picture));
    written.push_back(files.advice_picture);
  }
  if (!files.report.empty()) {
    TURNSCAN_TRY(write_file_atomically(files.report, report));
    written.push_back(files.report);
  }
  if (!files.page.empty()) {
    TURNSCAN_TRY(write_page(files.page, page_input(run, report, page_title(files.mesh)), context));
    written.push_back(files.page);
  }
  return written;
}

Result<std::vector<std::string>> write_outputs(const ReconstructFiles& files,
                                               const ReconstructRun& run,
                                               const ReconstructOptions& options,
                                               const RunContext& context) {
  TURNSCAN_ASSIGN(auto written, write_run_meshes(files, run));
  TURNSCAN_ASSIGN(const auto beside, write_beside(files, run, run_report(run, options), context));
  written.insert(written.end(), beside.begin(), beside.end());
  return written;
}

std::string run_report(const ReconstructRun& run, const ReconstructOptions& options) {
  auto report = nlohmann::ordered_json::parse(report_json(run.reconstruction, options));
  workflow::put_frame_residuals(run.frame_residuals, report);
  const auto& found = run.choice.calibration;
  report["calibration"] = found ? nlohmann::ordered_json::parse(calibration_json(*found)) : nullptr;
  report["next_pass"] = run.next_pass ? workflow::next_pass_json(*run.next_pass) : nullptr;
  return report.dump(2) + "\n";
}

PageInput page_input(const ReconstructRun& run, const std::string& report,
                     const std::string& title) {
  PageInput input;
  input.title = title;
  input.objects = page_objects(run.reconstruction);
  for (const PassApart& pass : run.apart) {
    for (PageObject& object : page_objects(pass.reconstruction))
      input.objects.push_back(std::move(object));
  }
  input.report = report;
  input.turn = run.turn;
  return input;
}

}  // namespace turnscan
