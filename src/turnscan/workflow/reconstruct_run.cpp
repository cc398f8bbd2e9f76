#include <turnscan/reconstruction/report.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>

#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include <turnscan/workflow/calibration/turntable_file.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/passes/placed_passes.hpp>

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

Result<Reconstruction> reconstruct_calibrated(const CalibratedFrames& calibrated,
                                              const ReconstructRequest& request,
                                              const StageSink& sink, const RunContext& context) {
  if (request.pass_poses.empty())
    return reconstruct(*calibrated.frames, calibrated.options, sink, context);
  TURNSCAN_ASSIGN(const PlacedPasses placed,
                  place_passes(*calibrated.frames, request.pass_poses, calibrated.options));
  return reconstruct(placed.frames, calibrated.options, sink, context, placed.placements);
}

}  // namespace

Result<ReconstructRun> run_reconstruction(const FrameSequence& sequence,
                                          const ReconstructRequest& request,
                                          const RunContext& context) {
  TURNSCAN_ASSIGN(const auto on_table, with_turntable(sequence, request.turntable));
  TURNSCAN_ASSIGN(CalibratedFrames calibrated,
                  calibrate_frames(*on_table, request.calibration, !request.turntable.empty(),
                                   request.options, context));
  calibrated.options.keep_points = request.stages.count("merged") > 0;
  ReconstructRun run;
  const StageSink sink = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
    if (request.stages.count(stage) > 0) run.stages[stage] = cloud;
    return {};
  };
  TURNSCAN_ASSIGN(run.reconstruction, reconstruct_calibrated(calibrated, request, sink, context));
  run.choice = std::move(calibrated.choice);
  std::vector<std::string>& notes = run.reconstruction.notes;
  if (!run.choice.note.empty()) notes.insert(notes.begin(), run.choice.note);
  if (!request.allow_open) TURNSCAN_TRY(check_watertight(run.reconstruction));
  TURNSCAN_TRY(context.check());
  return run;
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
  TURNSCAN_ASSIGN(std::vector<std::string> written, write_objects(files.mesh, run.reconstruction));
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
