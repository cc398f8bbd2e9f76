#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/text/text_table.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "commands/demo_scene.hpp"
#include "commands/stage_arguments.hpp"

namespace turnscan::cli {

namespace {

namespace fs = std::filesystem;

OptionTable describe(std::string& object, int& picture_size_px) {
  OptionTable table;
  table
      .text("object", object,
            fmt::format("Object on the turntable: {}, pair (letter-a and doll together), or all of "
                        "these but the gauges, one after the other",
                        fmt::join(builtin_object_names(), ", ")))
      .number("picture-size", picture_size_px, {16, 4096},
              "Width and height of each of the picture's three views in pixels");
  return table;
}

class DemoCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.option("-o,--out", "FOLDER", out_,
                "Folder to create; default: ./turnscan-demo, or the next free number");
    line.allow_config();
    line.group("demo", "Demo", describe(object_, scene_.picture_size_px));
    line.group("virtual-scan", "Virtual camera", describe(scene_.scan));
    declare_stages(line, scene_.reconstruct);
    line.group("evaluation", "Evaluation", describe(scene_.evaluate));
    line.common({"out", "object", "scanner", "frames", "noise", "triangles", "voxel-size", "method",
                 "texture", "scan-colour", "distance", "elevation"});
  }

  FileRoles files() const override { return {}; }

  Result<> run(Session& session) override {
    // "1.5mm" is short for "gaussian:1.5mm".
    std::string& noise = scene_.scan.measure.noise;
    if (parse_quantity(noise, Quantity::kLength)) noise = "gaussian:" + noise;
    TURNSCAN_ASSIGN(const std::vector<std::string> scenes, scene_names(object_));
    const fs::path folder = out_.empty() ? free_folder() : fs::path(out_);
    TURNSCAN_TRY(check_output_folder(folder.string()));
    const bool existed = fs::exists(folder);
    Result<> result = run_scenes(scenes, folder, session);
    // Nobody needs the partial results of a cancelled demo.
    if (!result && result.error().code == ErrorCode::kCancelled) discard(folder, scenes, existed);
    return result;
  }

 private:
  static void discard(const fs::path& folder, const std::vector<std::string>& scenes,
                      bool existed) {
    const auto own = file::Folder::open(folder);
    if (!own) return;
    for (const std::string& scene : scenes) (void)own->remove(scene);
    std::error_code ignored;
    if (!existed) fs::remove(folder, ignored);
  }

  Result<> run_scenes(const std::vector<std::string>& scenes, const fs::path& folder,
                      Session& session) const {
    workflow::TextTable table({0});
    table.add({"object", "frames", "triangles", "watertight", "accuracy", "completeness",
               "F at 1 mm", "seconds"});
    nlohmann::json figures{{"version", version()}, {"objects", nlohmann::json::array()}};
    PhasePlan plan;
    for (const std::string& name : scenes) plan = joined({plan, demo_phases(name, scene_)});
    session.plan(plan);
    for (const std::string& name : scenes) {
      TURNSCAN_ASSIGN(const std::vector<DemoFigures> results,
                      run_demo_scene(name, folder / name, scene_, session.context()));
      for (const DemoFigures& f : results) add(f, table, figures["objects"]);
    }
    TURNSCAN_TRY(write_file_atomically(folder / "figures.json", figures.dump(2) + "\n"));
    session.print("{}", table.text());
    session.print("Accuracy and completeness: median (p95) in mm over the seen surface.\n");
    session.print("Recording, mesh, reference, errors, picture and figures are in {}\n",
                  folder.string());
    return {};
  }

  static fs::path free_folder() {
    fs::path folder = "turnscan-demo";
    for (int i = 2; fs::exists(folder); ++i) folder = fmt::format("turnscan-demo-{}", i);
    return folder;
  }

  static void add(const DemoFigures& f, workflow::TextTable& table, nlohmann::json& figures) {
    const auto mm = [](const ErrorStatistics& e) {
      return fmt::format("{:.3f} ({:.3f})", e.median * 1e3, e.p95 * 1e3);
    };
    table.add({f.scene == f.object ? f.object : f.scene + "/" + f.object, std::to_string(f.frames),
               std::to_string(f.check.triangles), f.check.watertight() ? "yes" : "no",
               mm(f.evaluation.accuracy), mm(f.evaluation.completeness),
               fmt::format("{:.4f}", f.f_at_1mm), fmt::format("{:.1f}", f.seconds)});
    figures.push_back({{"scene", f.scene},
                       {"object", f.object},
                       {"frames", f.frames},
                       {"triangles", f.check.triangles},
                       {"watertight", f.check.watertight()},
                       {"f_at_1mm", f.f_at_1mm},
                       {"seconds", f.seconds},
                       {"evaluation", nlohmann::json::parse(to_json(f.evaluation))}});
  }

  std::string out_;
  std::string object_ = "doll";
  DemoSceneOptions scene_;
};

}  // namespace

std::unique_ptr<Command> make_demo_command() { return std::make_unique<DemoCommand>(); }

}  // namespace turnscan::cli
