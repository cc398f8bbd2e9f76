#pragma once
// A reconstruction as a command, a window or a script runs it: which calibration, which stages are
// kept, which files are written.
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
  std::set<std::string> stages;      ///< names of saveable_stages() whose clouds are wanted
  bool allow_open = false;           ///< a mesh that is not watertight is no failure
  /// Where passes lie that are fused with the first, by their number; the surfaces show the others.
  std::vector<PassPose> pass_poses;
  bool judge = true;  ///< with verdicts, and what only they need; else without
};

struct ReconstructRun {
  Reconstruction reconstruction;  ///< its notes begin with the choice's
  CalibrationChoice choice;
  std::map<std::string, PointCloud> stages;  ///< those that were asked for and made; table frame
  std::vector<PassApart> apart;              ///< passes that were not joined with the first
  std::vector<TurnPoint> turn;               ///< of the first recording, as it was calibrated
  PassViews seen_from;                       ///< of the last pass in the largest object's mesh
  std::optional<NextPassAdvice> next_pass;   ///< for the largest object; see advise_next_pass()
  /// Per object how its frames fit it; empty where it was not judged.
  std::vector<std::vector<FrameResidual>> frame_residuals;
};

/// One of the recordings of an object.
struct NamedSequence {
  std::string name;  ///< for people
  const FrameSequence* frames = nullptr;
};

/// The frames as a choice of calibration places them, with the options that go with it: where the
/// calibration has angles, a given speed is in them already.
struct CalibratedFrames {
  CalibrationChoice choice;
  std::unique_ptr<FrameSequence> frames;  ///< refers to the sequence it was made of
  ReconstructOptions options;
};

/// choose_calibration() with the options' speed, applied. table_given: see CalibrationRequest.
/// Fails as choose_calibration() and with_choice().
Result<CalibratedFrames> calibrate_frames(const FrameSequence& sequence, const std::string& mode,
                                          bool table_given, const ReconstructOptions& options,
                                          const RunContext& context);

/// The same for a choice that was made before. Fails as with_choice().
Result<CalibratedFrames> calibrated_by(const FrameSequence& sequence, CalibrationChoice choice,
                                       const ReconstructOptions& options);

/// Takes a run whose meshes are final, but of which nothing else is known yet.
using MeshSink = std::function<Result<>(const ReconstructRun&)>;

/// Calibrates, reconstructs, hands the meshes to write_meshes if it is given, and then says what is
/// known of them: advice, notes, verdicts. What fails of the latter becomes a note, so that nothing
/// after the meshes costs them. Where there are several passes, and neither one is chosen nor
/// frames have poses of their own, they become one mesh (workflow/passes/join_run.hpp).
/// Fails as with_turntable(), choose_calibration(), reconstruct(), join_and_reconstruct(),
/// write_meshes() and, unless allow_open is set, check_watertight(); with kCancelled.
Result<ReconstructRun> run_reconstruction(const FrameSequence& sequence,
                                          const ReconstructRequest& request,
                                          const RunContext& context,
                                          const MeshSink& write_meshes = {});

/// The same for all recordings of an object, each with its own sensors and calibration, at least
/// one; the choice is that of the first. Fails with kInvalidOption, too, when one pass is chosen.
Result<ReconstructRun> run_reconstruction(const std::vector<NamedSequence>& recordings,
                                          const ReconstructRequest& request,
                                          const RunContext& context,
                                          const MeshSink& write_meshes = {});

/// Fails with kMissingData, naming each and why, when passes were not joined.
Result<> check_joined(const std::vector<PassApart>& apart);

/// Names of files; an empty one is not written.
struct ReconstructFiles {
  std::string mesh;  ///< required; see write_objects()
  WriteMeshOptions mesh_options;
  std::string report;                         ///< .json
  std::string page;                           ///< .html, see make_page()
  std::map<std::string, std::string> stages;  ///< .ply, by stage
  std::string advice_picture;                 ///< .png; see next_pass_picture()
};

/// Whether they can be written, to be asked before the work begins. Fails as check_mesh_file() and
/// check_output_file().
Result<> check_outputs(const ReconstructFiles& files);

/// Where the mesh of a pass apart is written: MESH-passN.
std::string mesh_of_pass(const std::string& mesh, std::uint32_t pass);

/// Writes the meshes, those of passes apart as MESH-passN; returns the names of the files. Fails as
/// write_objects().
Result<std::vector<std::string>> write_run_meshes(const ReconstructFiles& files,
                                                  const ReconstructRun& run);

/// Writes what belongs to the meshes: the stages' clouds, the picture of the advice, the report and
/// the page; returns the names of the files in that order. report: see run_report(). A stage that
/// the run did not keep and a picture of an advice that there is not are left out. Fails as
/// write_cloud(), next_pass_picture(), write_file_atomically() and make_page().
Result<std::vector<std::string>> write_beside(const ReconstructFiles& files,
                                              const ReconstructRun& run, const std::string& report,
                                              const RunContext& context = {});

/// Both, with run_report(). options: as they were asked for.
Result<std::vector<std::string>> write_outputs(const ReconstructFiles& files,
                                               const ReconstructRun& run,
                                               const ReconstructOptions& options,
                                               const RunContext& context = {});

/// What is known of a run, as --report writes it: report_json() with the advice for the next pass
/// and how the frames fit.
std::string run_report(const ReconstructRun& run, const ReconstructOptions& options);

/// What make_page() shows of a run: all meshes, those of passes apart last. report: see
/// run_report().
PageInput page_input(const ReconstructRun& run, const std::string& report,
                     const std::string& title);

}  // namespace turnscan
