#include <turnscan/workflow/scan/scan.hpp>

#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "commands/capture_arguments.hpp"
#include "commands/stage_arguments.hpp"

namespace turnscan::cli {

namespace {

class ScanCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.required_repeatable("--device", "URI", request_.setup.devices,
                             "Sensor to scan with, e.g. virtual:doll (see docs/capture.md). May be "
                             "given several times: one mesh from all of them");
    line.required_option("-o,--out", "MESH", request_.mesh,
                         "Mesh to write: .ply, .obj or .glb in metres, .stl or .3mf in mm");
    line.option("--recording", "FOLDER", request_.recording,
                "Folder to make for the recording, by default beside the mesh. It is kept");
    line.flag("--overwrite-unfinished", request_.overwrite_unfinished,
              "Remove the recording that lies there when it was not finished");
    line.option("--report", "FILE.json", request_.report,
                "Write what was recorded and reconstructed as JSON");
    line.flag("--no-wait", no_wait_, "Do not wait until something stands on the platter");
    line.flag("--allow-open", request_.allow_open, "Write meshes that are not watertight, too");
    declare_capture(line, request_.setup);
    line.group("limits", "End of the recording", describe(request_.setup.options.limits));
    line.group("ahead", "Work while frames come", describe(request_.ahead));
    declare_stages(line, request_.reconstruct);
  }

  FileRoles files() const override {
    return {with_replayed(request_.setup.devices, request_.setup.turntable_file),
            {request_.mesh, request_.report},
            request_.mesh,
            request_.overwrite_unfinished ? recording_of(request_) : std::string()};
  }

  HelpScope help_scope() const override { return stages_help_scope(request_.reconstruct); }

  Result<> run(Session& session) override {
    request_.wait = !no_wait_;
    const ScanHooks hooks{progress_in(session), [&session] { session.status().set(""); }};
    TURNSCAN_ASSIGN(const ScanOutcome outcome, run_scan(request_, hooks, session.context()));
    session.print("{}", scan_text(outcome));
    return {};
  }

 private:
  ScanRequest request_;
  bool no_wait_ = false;
};

}  // namespace

std::unique_ptr<Command> make_scan_command() { return std::make_unique<ScanCommand>(); }

}  // namespace turnscan::cli
