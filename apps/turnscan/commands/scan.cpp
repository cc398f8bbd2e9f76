#include <unistd.h>

#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/scan.hpp>

#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "commands/capture_arguments.hpp"
#include "commands/stage_arguments.hpp"
#ifdef TURNSCAN_WITH_SERVE
#include "remote/remote_scan.hpp"
#endif

namespace turnscan::cli {

namespace {

/// Number of passes of the object, each one turn of the table.
struct PassCount {
  std::optional<int> passes;
};

OptionTable describe(PassCount& count) {
  OptionTable table;
  table.number(
      "passes", count.passes, {1, 100},
      "Number of passes to record and join, each with the object laid differently. Before each "
      "further pass the program says what is missing and how to lay the object, and waits for "
      "Enter; virtual objects are laid automatically. auto: asks at a terminal, else 1");
  return table;
}

class ScanCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.required_repeatable(
        "--device", "URI", request_.setup.devices,
        "Sensor to scan with, e.g. virtual:doll (see docs/reference/capture.md). May be "
        "given several times: one mesh from all of them");
    line.required_option("-o,--out", "MESH", request_.mesh,
                         "Mesh to write: .ply, .obj or .glb in metres, .stl or .3mf in mm");
    line.option("--recording", "FOLDER", request_.recording,
                "Folder to create for the recording, by default beside the mesh. It is kept");
    line.option("--resume", "RECORDING", resume_, kResumeHelp);
    line.flag("--overwrite-unfinished", request_.overwrite_unfinished,
              "Replace the recording there if it was not finished");
    line.repeatable("--report", "FILE.json|FILE.html", reports_,
                    "Write a report of the recording and the mesh. .json: for programs; .html: a "
                    "page in one file, with the model in 3D. Both may be given");
    line.option("--advice-picture", "FILE.png", request_.advice_picture,
                "Draw how to lay the object for the next pass, beside how it lay; surface that no "
                "view saw is magenta");
#ifdef TURNSCAN_WITH_SERVE
    line.option("--server", "URL", server_,
                "Scan on a rig that turnscan serve offers, e.g. http://rig:8470, with the options "
                "that it was started with. Its token is read from the environment variable "
                "TURNSCAN_TOKEN. The recording stays there, and is copied if --recording names a "
                "folder");
    line_ = &line;
#endif
    declare_scan(line, request_, no_wait_);
    line.group("passes", "Passes", describe(passes_));
    line.group("limits", "End of the recording", describe(request_.setup.options.limits));
    line.group("ahead", "Processing while recording", describe(request_.ahead));
    line.group("mesh-file", "Mesh file", describe(request_.mesh_options));
    declare_stages(line, request_.reconstruct);
    line.common({"device", "out", "passes", "turns", "speed", "motor", "triangles", "up",
                 "voxel-size", "texture", "turntable", "report"});
  }

  FileRoles files() const override {
    std::vector<std::string> outputs{request_.mesh, request_.advice_picture};
    outputs.insert(outputs.end(), reports_.begin(), reports_.end());
    for (const std::string& file : texture_files_of(request_.mesh, request_.reconstruct.texture))
      outputs.push_back(file);
    return {with_replayed(request_.setup.devices, request_.setup.turntable_file), outputs,
            request_.mesh, request_.overwrite_unfinished ? recording_of(request_) : resume_};
  }

  Result<> run(Session& session) override {
    request_.wait = !no_wait_;
    if (!resume_.empty() && !request_.recording.empty())
      return fail(
          ErrorCode::kInvalidOption,
          "name either a new recording with --recording or one to go on with with --resume");
    request_.setup.options.resume = !resume_.empty();
    if (!resume_.empty()) request_.recording = resume_;
    TURNSCAN_ASSIGN(const ReportFiles reports, sort_report_files(reports_));
    request_.report = reports.json;
    request_.page = reports.page;
    request_.passes = passes_.passes;
    ScanHooks hooks{progress_in(session), [&session] { session.status().set(""); }, {}};
    if (request_.passes.value_or(0) > 1 || (!request_.passes && at_terminal()))
      hooks.another_side = [&](const std::string& advice, std::uint32_t pass) {
        return another_side(session, advice, pass);
      };
#ifdef TURNSCAN_WITH_SERVE
    if (!server_.empty()) return run_there(hooks, session);
#endif
    session.plan(scan_phases(request_));
    TURNSCAN_ASSIGN(const ScanOutcome outcome, run_scan(request_, hooks, session.context()));
    session.print("{}", scan_text(outcome));
    return check_joined(outcome.run.apart);
  }

 private:
#ifdef TURNSCAN_WITH_SERVE
  Result<> run_there(const ScanHooks& hooks, Session& session) {
    TURNSCAN_TRY(remote::check_given(*line_, {"device", "out", "recording", "report",
                                              "advice-picture", "passes", "overwrite-unfinished"}));
    TURNSCAN_ASSIGN(auto rig, remote::RemoteRig::open(server_, session.context()));
    return remote::run_remote_scan(rig, request_, hooks.another_side, session);
  }

  const CommandLine* line_ = nullptr;
  std::string server_;
#endif
  static bool at_terminal() { return isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1; }

  Result<bool> another_side(Session& session, const std::string& advice, std::uint32_t pass) const {
    TURNSCAN_ASSIGN(const auto answer,
                    session.ask(fmt::format("{}\nAnother side? Lay the object like this and press "
                                            "Enter to record pass {}, or type q to end: ",
                                            advice, pass)));
    if (answer) return answer->empty() || (answer->front() != 'q' && answer->front() != 'n');
    if (!request_.passes) return false;
    return fail(ErrorCode::kMissingData,
                "standard input has ended, so that nobody can confirm that the object was laid "
                "another way; the mesh of the passes so far is in {}",
                request_.mesh);
  }

  ScanRequest request_;
  std::vector<std::string> reports_;
  PassCount passes_;
  std::string resume_;
  bool no_wait_ = false;
};

}  // namespace

std::unique_ptr<Command> make_scan_command() { return std::make_unique<ScanCommand>(); }

}  // namespace turnscan::cli
