#include <turnscan/workflow/export/export_run.hpp>
#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/output_file.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

std::string layouts_help() {
  std::string text = "Layout to write: ";
  for (const exporters::ExportLayout& layout : exporters::export_layouts())
    text += fmt::format("{}{} ({})", layout.format == ExportFormat::kColmap ? "" : ", ",
                        layout.name, layout.help);
  return text;
}

class ExportCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional("RECORDING", recording_,
                    "Recording to export, or a file or folder of another program (see turnscan "
                    "import)");
    line.required_option("--to", "LAYOUT", layout_, layouts_help());
    line.required_option("-o,--out", "FOLDER", out_,
                         "Folder to create; if it exists, it must be empty");
    line.option("--mesh", "MESH", request_.mesh,
                "Mesh of the object that turnscan reconstruct made: its silhouette becomes the "
                "images' masks, its vertices the initial points or the model");
    line.option(
        "--turntable", "FILE.json", request_.turntable,
        "Calibration to use instead of the recording's: a file saved by turnscan calibrate");
    line.option("--calibration", "WAY", request_.calibration,
                "Source of the turntable's pose and the angles: auto, recorded or motion (see "
                "turnscan reconstruct)");
    line.repeatable("--import", "NAME=VALUE", import_, kImportOptionsHelp);
    line.allow_config();
    line.group("export", "Export", describe(request_.options));
    line.common({"to", "out", "mesh", "every", "depth-unit", "pass", "turntable", "calibration",
                 "speed", "import"});
  }

  FileRoles files() const override { return {{recording_, request_.mesh, request_.turntable}, {}}; }

  Result<> run(Session& session) override {
    TURNSCAN_ASSIGN(request_.format, export_format(layout_));
    TURNSCAN_TRY(request_.options.check());
    TURNSCAN_TRY(check_output_folder(out_));
    TURNSCAN_ASSIGN(const Input input, open_input_asking(recording_, import_, session.context()));
    session.plan(export_phases(*input.frames));
    TURNSCAN_ASSIGN(const ExportSummary made,
                    export_recording(*input.frames, request_, out_, session.context()));
    session.print("{} colour images, {} depth images, {} masks\n", made.color_images,
                  made.depth_images, made.masks);
    for (const auto& notes : {made.notes, input.notes})
      for (const std::string& note : notes) session.print("Note: {}\n", note);
    session.print("Wrote {}\n", out_);
    return {};
  }

 private:
  std::string recording_, layout_, out_;
  std::vector<std::string> import_;
  ExportRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_export_command() { return std::make_unique<ExportCommand>(); }

}  // namespace turnscan::cli
