#include <algorithm>
#include <turnscan/reconstruction/pipeline.hpp>

#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "commands/stage_arguments.hpp"

namespace turnscan::cli {

namespace {

class ReconstructCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positionals("RECORDING...", recordings_,
                     "Recording to reconstruct, or a file or folder of another program (see "
                     "turnscan import). Its passes, in which the object is laid differently, "
                     "become one mesh, and so do several recordings of one object");
    line.required_option("-o,--out", "MESH", files_.mesh,
                         "Mesh to write: .ply, .obj or .glb in metres, .stl or .3mf in mm. Several "
                         "objects become OUT-1, OUT-2, ..., or one .3mf or .glb file. Passes that "
                         "cannot be joined become OUT-pass1, ..., and the command fails");
    line.repeatable(
        "--report", "FILE.json|FILE.html", reports_,
        "Write a report: counts, parameters with their reasons, times, checks. .json: for "
        "programs; .html: a page in one file, with the model in 3D. Both may be given");
    line.option("--advice-picture", "FILE.png", files_.advice_picture,
                "Draw how to lay the object for the next pass, beside how it lay; surface that no "
                "view saw is magenta");
    line.repeatable(
        "--save-stage", "NAME[=FILE.ply]", save_stages_,
        fmt::format("Write a stage's cloud, by default beside the mesh: {} (fitted with "
                    "--method volumetric, the others without)",
                    fmt::join(saveable_stages(), ", ")));
    line.repeatable("--import", "NAME=VALUE", import_, kImportOptionsHelp);
    line.option("--keep-recording", "FOLDER", keep_recording_,
                "Folder for a recording of what is read from files of another program, as turnscan "
                "import writes it; if it exists, it must be empty");
    line.option(
        "--turntable", "FILE.json", request_.turntable,
        "Calibration to use instead of the recording's: a file saved by turnscan calibrate");
    line.option("--calibration", "WAY", request_.calibration,
                "Source of the turntable's pose and the angles: auto, recorded or motion. auto: "
                "the recording, or the object's motion if the recording has none or they do not "
                "fit one turn later");
    line.repeatable(
        "--pass-pose", "PASS=POSE", pass_poses_,
        "Pose of a pass, if its surface does not determine it: the number of the pass (counted "
        "from 0 across all recordings) and the pose of its table in the frame of the first pass's "
        "table, either a file with a 4x4 matrix (row by row, in metres) or RX,RY,RZ,TX,TY,TZ: "
        "rotations about the fixed axes x, y and z in this order, then a translation, e.g. "
        "1=180deg,0deg,30deg,0mm,200mm,0mm; may be given for several passes");
    line.flag("--refine-pass-poses", refine_pass_poses_,
              "Take the poses of --pass-pose as approximate: each pass is registered to the others "
              "from there, and is not joined if their surfaces contradict each other");
    line.flag("--allow-open", request_.allow_open, "Write meshes that are not watertight, too");
    line.allow_config();
    line.group("mesh-file", "Mesh file", describe(files_.mesh_options));
    declare_stages(line, request_.options);
    line.common({"out", "triangles", "up", "voxel-size", "texture", "speed", "method", "turntable",
                 "import", "keep-box", "report", "quiet"});
  }

  FileRoles files() const override {
    FileRoles files{recordings_, {files_.mesh, files_.advice_picture}, files_.mesh};
    files.outputs.insert(files.outputs.end(), reports_.begin(), reports_.end());
    files.inputs.push_back(request_.turntable);
    for (const std::string& file : texture_files_of(files_.mesh, request_.options.texture))
      files.outputs.push_back(file);
    for (const std::string& text : save_stages_) files.outputs.push_back(stage_file(text));
    for (const std::string& text : pass_poses_)
      files.inputs.push_back(text.substr(text.find('=') + 1));
    return files;
  }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(check_files());
    TURNSCAN_ASSIGN(const std::vector<Input> inputs, open_inputs(session.context()));
    std::vector<NamedSequence> named;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      named.push_back({recordings_[i], inputs[i].frames.get()});
    for (const auto& [stage, file] : files_.stages) request_.stages.insert(stage);
    session.plan(joined(
        {reconstruct_phases(named, request_), files_.page.empty() ? PhasePlan() : page_phases()}));
    std::vector<std::string> files;
    const auto write_meshes = [&](const ReconstructRun& run) -> Result<> {
      TURNSCAN_ASSIGN(files, write_run_meshes(files_, run));
      return {};
    };
    TURNSCAN_ASSIGN(const ReconstructRun made,
                    run_reconstruction(named, request_, session.context(), write_meshes));
    TURNSCAN_ASSIGN(
        const auto beside,
        write_beside(files_, made, run_report(made, request_.options), session.context()));
    files.insert(files.end(), beside.begin(), beside.end());
    session.print("{}", text_of(made));
    if (made.next_pass) session.print("Next pass: {}\n", next_pass_text(*made.next_pass));
    for (const Input& input : inputs) {
      for (const std::string& note : input.notes) session.print("Note: {}\n", note);
    }
    for (const std::string& file : files) session.print("Wrote {}\n", file);
    return check_joined(made.apart);
  }

 private:
  Result<std::vector<Input>> open_inputs(const RunContext& context) const {
    TURNSCAN_ASSIGN(const ImportOptions options, parse_import_options(import_));
    std::vector<Input> inputs;
    bool imported = false;
    for (const std::string& path : recordings_) {
      TURNSCAN_ASSIGN(Input input, open_input_asking(path, options, context));
      imported |= input.imported;
      inputs.push_back(std::move(input));
    }
    if (!imported && !import_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--import: the input is a recording already; leave it out");
    if (keep_recording_.empty()) return inputs;
    if (inputs.size() > 1)
      return fail(
          ErrorCode::kInvalidOption,
          "--keep-recording writes one recording; convert several inputs with turnscan import");
    TURNSCAN_ASSIGN(inputs[0], keep_input(recordings_[0], inputs[0], keep_recording_, context));
    return inputs;
  }

  static std::string text_of(const ReconstructRun& made) {
    const bool any = made.apart.empty() || !made.reconstruction.objects.empty();
    std::string text = any ? reconstruction_text(made.reconstruction) : "";
    for (const PassApart& pass : made.apart)
      text += fmt::format("{}{} by itself: {}", text.empty() ? "" : "\n", pass.name,
                          reconstruction_text(pass.reconstruction));
    return text;
  }

  Result<> check_files() {
    TURNSCAN_ASSIGN(const ReportFiles reports, sort_report_files(reports_));
    files_.report = reports.json;
    files_.page = reports.page;
    TURNSCAN_TRY(check_outputs(files_));
    if (!keep_recording_.empty()) TURNSCAN_TRY(check_output_folder(keep_recording_));
    TURNSCAN_TRY(
        check_textured_mesh_file(files_.mesh, request_.options.texture, files_.mesh_options));
    for (const std::string& text : save_stages_) TURNSCAN_TRY(add_stage_file(text));
    for (const std::string& text : pass_poses_) {
      TURNSCAN_ASSIGN(PassPose pose, parse_pass_pose(text));
      pose.refine = refine_pass_poses_;
      request_.pass_poses.push_back(std::move(pose));
    }
    if (refine_pass_poses_ && pass_poses_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--refine-pass-poses refines the poses of --pass-pose; give that, too");
    return {};
  }

  Result<> add_stage_file(const std::string& text) {
    const auto equals = text.find('=');
    const std::string stage = text.substr(0, equals);
    const auto& stages = saveable_stages();
    if (std::find(stages.begin(), stages.end(), stage) == stages.end())
      return fail(ErrorCode::kInvalidOption,
                  "--save-stage {}: there is no such stage; use one of {}", stage,
                  fmt::join(stages, ", "));
    const auto made = saveable_stages(request_.options.surface.method);
    if (std::find(made.begin(), made.end(), stage) == made.end())
      return fail(ErrorCode::kInvalidOption,
                  "--save-stage {}: this method has no such stage; choose another --method, or one "
                  "of {}",
                  stage, fmt::join(made, ", "));
    if (stage == "sub-voxels" && request_.options.candidates.method != CandidateMethod::kSubVoxel)
      return fail(ErrorCode::kInvalidOption,
                  "--save-stage {}: they are not counted; give --candidates sub-voxel", stage);
    files_.stages[stage] = stage_file(text);
    return check_output_file(files_.stages[stage], ".ply");
  }

  /// "NAME=FILE.ply", or "NAME" for a file next to the mesh.
  std::string stage_file(const std::string& text) const {
    const auto equals = text.find('=');
    if (equals != std::string::npos) return text.substr(equals + 1);
    const std::string& mesh = files_.mesh;
    return with_suffix(mesh.substr(0, mesh.size() - ending_of(mesh).size()) + ".ply", "-" + text);
  }

  std::vector<std::string> recordings_;
  std::vector<std::string> save_stages_, pass_poses_, reports_, import_;
  std::string keep_recording_;
  bool refine_pass_poses_ = false;
  ReconstructFiles files_;
  ReconstructRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_reconstruct_command() {
  return std::make_unique<ReconstructCommand>();
}

}  // namespace turnscan::cli
