#include <algorithm>
#include <map>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/cloud_io.hpp>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/recording/recording.hpp>

#include "calibration_choice.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "output_file.hpp"
#include "reconstruction_text.hpp"
#include "turntable_file.hpp"

namespace turnscan::cli {

namespace {

class ReconstructCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional("RECORDING", recording_, "Recording to reconstruct (see turnscan import)");
    line.required_option("-o,--out", "MESH", out_,
                         "Mesh to write: .ply, .obj or .glb in metres, .stl or .3mf in mm. Several "
                         "objects become OUT-1, OUT-2, ..., or one .3mf or .glb file");
    line.option(
        "--report", "FILE.json", report_,
        "Write what was done as JSON: counts, parameters with their reasons, times, checks");
    line.repeatable(
        "--save-stage", "NAME[=FILE.ply]", save_stages_,
        fmt::format("Write a stage's cloud, by default beside the mesh: {} (fitted with "
                    "--method volumetric, the others without)",
                    fmt::join(saveable_stages(), ", ")));
    line.option(
        "--turntable", "FILE.json", turntable_,
        "Turntable to use instead of the recording's: a file that turnscan calibrate saved");
    line.option(
        "--calibration", "WAY", calibration_,
        "Where turntable and angles come from: auto, recorded or motion. auto: from the object's "
        "motion where the "
        "recording has none, or one that does not fit one turn later. For comparison also free "
        "registration: icp-consecutive, icp-global, gicp-consecutive, gicp-global");
    line.flag("--allow-open", allow_open_, "Write meshes that are not watertight, too");
    line.allow_config();
    for (StageOptions& stage : describe_stages(options_))
      line.group(stage.stage, "Stage " + stage.stage, std::move(stage.table));
  }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(check_outputs());
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(recording_));
    TURNSCAN_ASSIGN(const auto sequence, with_turntable(recording, turntable_));
    ReconstructOptions options = options_;
    TURNSCAN_ASSIGN(const CalibrationChoice choice,
                    choose_calibration(
                        *sequence, {calibration_, options.merge.speed_rad_s, !turntable_.empty()},
                        session.context()));
    TURNSCAN_ASSIGN(const auto frames, with_choice(*sequence, choice));
    if (choice.calibration) options.merge.speed_rad_s.reset();  // it is in the angles
    // Saved only at the end, with the mesh: a run that fails leaves nothing behind.
    options.keep_points = stage_files_.count("merged") > 0;
    const StageSink sink = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
      if (stage_files_.count(stage) > 0) clouds_[stage] = cloud;
      return {};
    };
    TURNSCAN_ASSIGN(Reconstruction result, reconstruct(*frames, options, sink, session.context()));
    if (!choice.note.empty()) result.notes.insert(result.notes.begin(), choice.note);
    if (!allow_open_) TURNSCAN_TRY(check_watertight(result));
    TURNSCAN_TRY(session.context().check());
    TURNSCAN_ASSIGN(const auto files, write_all(result));
    session.print("{}", reconstruction_text(result));
    for (const std::string& note : recording.notes()) session.print("Note: {}\n", note);
    for (const std::string& file : files) session.print("Wrote {}\n", file);
    return {};
  }

 private:
  Result<> check_outputs() {
    if (auto good = check_mesh_output(out_); !good) {
      Error error = std::move(good).error();
      if (error.code == ErrorCode::kUnsupported) error.code = ErrorCode::kInvalidOption;
      return tl::unexpected<Error>(std::move(error));
    }
    TURNSCAN_TRY(check_output_file(report_, ".json"));
    for (const std::string& text : save_stages_) TURNSCAN_TRY(add_stage_file(text));
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
    const auto made = saveable_stages(options_.surface.method);
    if (std::find(made.begin(), made.end(), stage) == made.end())
      return fail(ErrorCode::kInvalidOption,
                  "--save-stage {}: this method has no such stage; choose another --method, or one "
                  "of {}",
                  stage, fmt::join(made, ", "));
    const std::string file =
        equals == std::string::npos
            ? with_suffix(out_.substr(0, out_.size() - ending_of(out_).size()) + ".ply",
                          "-" + stage)
            : text.substr(equals + 1);
    stage_files_[stage] = file;
    return check_output_file(file, ".ply");
  }

  Result<std::vector<std::string>> write_all(const Reconstruction& result) const {
    TURNSCAN_ASSIGN(std::vector<std::string> files, write_objects(out_, result));
    for (const auto& [stage, cloud] : clouds_) {
      TURNSCAN_TRY(write_cloud(stage_files_.at(stage), cloud));
      files.push_back(stage_files_.at(stage));
    }
    if (!report_.empty()) {
      TURNSCAN_TRY(write_file_atomically(report_, report_json(result, options_)));
      files.push_back(report_);
    }
    return files;
  }

  std::string recording_, out_, report_, turntable_, calibration_ = "auto";
  std::vector<std::string> save_stages_;
  bool allow_open_ = false;
  ReconstructOptions options_;
  std::map<std::string, std::string> stage_files_;
  std::map<std::string, PointCloud> clouds_;
};

}  // namespace

std::unique_ptr<Command> make_reconstruct_command() {
  return std::make_unique<ReconstructCommand>();
}

}  // namespace turnscan::cli
