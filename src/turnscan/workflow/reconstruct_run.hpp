#pragma once
// Reconstruction as run by a command, a window or a script: choice of calibration, stages to keep,
// files to write.
//
//   TURNSCAN_TRY(check_outputs(files));
//   TURNSCAN_ASSIGN(const Input input, open_input("doll.recording"));
//   TURNSCAN_ASSIGN(const ReconstructRun run, run_reconstruction(*input.frames, request, context));
//   TURNSCAN_ASSIGN(const auto written, write_outputs(files, run, request.options));

#include <functional>
#include <map>
#include <set>
#include <string>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <turnscan/workflow/passes/join_run.hpp>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <vector>

namespace turnscan {

struct ReconstructRequest {
  ReconstructOptions options;
  std::string calibration = "auto";  ///< CalibrationRequest::mode
  std::string turntable;             ///< see with_turntable(); empty: the recording's
  std::set<std::string> stages;      ///< names of saveable_stages() whose clouds are requested
  bool allow_open = false;           ///< accept a mesh that is not watertight
  /// Poses of passes that are fused with the first, by number; other passes are registered by their
  /// surfaces.
  std::vector<PassPose> pass_poses;
  bool judge = true;  ///< compute verdicts, and what only they need
};

struct ReconstructRun {
  Reconstruction reconstruction;  ///< its notes begin with those of the choice
  CalibrationChoice choice;
  std::map<std::string, PointCloud> stages;  ///< the requested ones that were made; table frame
  std::vector<PassApart> apart;              ///< passes that were not joined with the first
  std::vector<TurnPoint> turn;               ///< of the first recording, as calibrated
  PassViews seen_from;  ///< viewpoints of the last pass in the frame of the largest object's mesh
  std::optional<NextPassAdvice> next_pass;  ///< for the largest object; see advise_next_pass()
  /// Per object the fit of its frames; empty if it was not judged.
  std::vector<std::vector<FrameResidual>> frame_residuals;
};

/// One of the recordings of an object.
struct NamedSequence {
  std::string name;  ///< human-readable
  const FrameSequence* frames = nullptr;
};

/// Frames posed by a choice of calibration, and the matching options: if the calibration has
/// angles, a given speed is already accounted for in them.
struct CalibratedFrames {
  CalibrationChoice choice;
  std::unique_ptr<FrameSequence> frames;  ///< refers to the sequence it was made from
  ReconstructOptions options;
};

/// Applies choose_calibration() with the options' speed. table_given: see CalibrationRequest. Fails
/// as choose_calibration() and with_choice().
Result<CalibratedFrames> calibrate_frames(const FrameSequence& sequence, const std::string& mode,
                                          bool table_given, const ReconstructOptions& options,
                                          const RunContext& context);

/// The same for an existing choice. Fails as with_choice().
Result<CalibratedFrames> calibrated_by(const FrameSequence& sequence, CalibrationChoice choice,
                                       const ReconstructOptions& options);

/// Receives a run whose meshes are final but whose other results are not known yet.
using MeshSink = std::function<Result<>(const ReconstructRun&)>;

/// Calibrates, reconstructs, passes the meshes to write_meshes if given, and then computes the
/// rest: advice, notes, verdicts. Failures of the latter become notes, so that nothing after the
/// meshes can lose them. If there are several passes, no single one is chosen and the frames have
/// no poses of their own, the passes are fused into one mesh (workflow/passes/join_run.hpp).
/// Fails as with_turntable(), choose_calibration(), reconstruct(), join_and_reconstruct(),
/// write_meshes() and, unless allow_open is set, check_watertight(); with kCancelled.
Result<ReconstructRun> run_reconstruction(const FrameSequence& sequence,
                                          const ReconstructRequest& request,
                                          const RunContext& context,
                                          const MeshSink& write_meshes = {});

/// The same for all recordings of an object (at least one), each with its own sensors and
/// calibration; the choice is that of the first. Also fails with kInvalidOption if a single pass is
/// chosen.
Result<ReconstructRun> run_reconstruction(const std::vector<NamedSequence>& recordings,
                                          const ReconstructRequest& request,
                                          const RunContext& context,
                                          const MeshSink& write_meshes = {});

/// Fails with kMissingData if passes were not joined, naming each and the reason.
Result<> check_joined(const std::vector<PassApart>& apart);

/// Names of output files; empty: not written.
struct ReconstructFiles {
  std::string mesh;  ///< required; see write_objects()
  WriteMeshOptions mesh_options;
  std::string report;                         ///< .json
  std::string page;                           ///< .html, see make_page()
  std::map<std::string, std::string> stages;  ///< .ply, by stage
  std::string advice_picture;                 ///< .png; see next_pass_picture()
};

/// Checks before the work begins whether the files can be written. Fails as check_mesh_file() and
/// check_output_file().
Result<> check_outputs(const ReconstructFiles& files);

/// File name for the mesh of a separate pass: MESH-passN.
std::string mesh_of_pass(const std::string& mesh, std::uint32_t pass);

/// Writes the meshes, those of separate passes as MESH-passN; returns the names of the files. Fails
/// as write_objects().
Result<std::vector<std::string>> write_run_meshes(const ReconstructFiles& files,
                                                  const ReconstructRun& run);

/// Writes what accompanies the meshes: the stages' clouds, the picture of the advice, the report
/// and the page; returns the names of the files in that order. report: see run_report(). Skips
/// stages that the run did not keep, and the picture if there is no advice. Fails as write_cloud(),
/// next_pass_picture(), write_file_atomically() and make_page().
Result<std::vector<std::string>> write_beside(const ReconstructFiles& files,
                                              const ReconstructRun& run, const std::string& report,
                                              const RunContext& context = {});

/// Writes both, with run_report(). options: as requested.
Result<std::vector<std::string>> write_outputs(const ReconstructFiles& files,
                                               const ReconstructRun& run,
                                               const ReconstructOptions& options,
                                               const RunContext& context = {});

/// The report that --report writes: report_json() with the calibration that was found (null: the
/// recording's own), the advice for the next pass and the fit of the frames.
std::string run_report(const ReconstructRun& run, const ReconstructOptions& options);

/// The content of make_page() for a run: all meshes, those of separate passes last. report: see
/// run_report().
PageInput page_input(const ReconstructRun& run, const std::string& report,
                     const std::string& title);

}  // namespace turnscan
