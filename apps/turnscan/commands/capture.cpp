#include <turnscan/io/file/atomic_file.hpp>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/scan/capture_outcome.hpp>
#include <turnscan/workflow/scan/capture_report.hpp>
#include <turnscan/workflow/text/capture_text.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "commands/capture_arguments.hpp"
#include "remote/remote_scan.hpp"

namespace turnscan::cli {

namespace {

class CaptureCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.required_repeatable(
        "--device", "URI", setup_.devices,
        "Sensor to record from, e.g. virtual:doll (see docs/reference/capture.md). May "
        "be given several times, for one recording of all of them");
    line.option("-o,--out", "RECORDING", out_,
                "Folder to create for the recording; if it exists, it must be empty");
    line.option("--resume", "RECORDING", resume_, kResumeHelp);
    line.flag("--overwrite-unfinished", overwrite_unfinished_, kOverwriteUnfinishedHelp);
    line.option("--report", "FILE.json", report_, "Write what was recorded and dropped as JSON");
#ifdef TURNSCAN_WITH_SERVE
    line.option(
        "--server", "URL", server_,
        "Record on a rig that turnscan serve offers, e.g. http://rig:8470, with the options "
        "that it was started with, and copy the recording here. Its token is read from the "
        "environment variable TURNSCAN_TOKEN");
    line_ = &line;
#endif
    declare_capture(line, setup_);
    declare_table(line, setup_);
    line.group("limits", "End of the recording", describe(setup_.options.limits));
    line.common({"device", "out", "turns", "seconds", "speed", "motor", "turntable", "crop",
                 "color-files", "report", "resume", "overwrite-unfinished"});
  }

  FileRoles files() const override {
    return {with_replayed(setup_.devices, setup_.turntable_file),
            {report_},
            {},
            overwrite_unfinished_ ? out_ : resume_};
  }

  Result<> run(Session& session) override {
    if (out_.empty() == resume_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "name either a new recording with --out or one to go on with with --resume");
    setup_.options.resume = !resume_.empty();
    if (setup_.options.resume)
      out_ = resume_;
    else
      TURNSCAN_TRY(check_output_folder(out_, overwrite_unfinished_));
    TURNSCAN_TRY(check_output_file(report_, ".json"));
#ifdef TURNSCAN_WITH_SERVE
    if (!server_.empty()) return run_there(session);
#endif
    session.plan(capture_phases());
    TURNSCAN_ASSIGN(auto source, setup_.open(session.context()));
    TURNSCAN_ASSIGN(std::optional<Motor> motor, setup_.open_motor(session.context()));
    CaptureHooks hooks;
    hooks.motor = motor ? &*motor : nullptr;
    hooks.progress = progress_in(session);
    TURNSCAN_TRY(source->start());
    if (!setup_.options.resume) TURNSCAN_TRY(clear_output_folder(out_, overwrite_unfinished_));
    session.context().begin_phase("record", 1000);
    TURNSCAN_ASSIGN(const CaptureResult result,
                    turnscan::capture(*source, out_, setup_.header, setup_.settings, setup_.options,
                                      hooks, session.context()));
    source->stop();
    session.status().set("");
    if (!report_.empty())
      TURNSCAN_TRY(write_file_atomically(report_, capture_report(result, source->info(), out_)));
    TURNSCAN_TRY(capture_outcome(result, out_));
    session.print("{}", capture_text(result, out_));
    if (!report_.empty()) session.print("Wrote {}\n", report_);
    return {};
  }

 private:
#ifdef TURNSCAN_WITH_SERVE
  Result<> run_there(Session& session) {
    TURNSCAN_TRY(remote::check_given(*line_, {"device", "out", "overwrite-unfinished"}));
    ScanRequest request;
    request.setup.devices = setup_.devices;
    request.recording = out_;
    request.overwrite_unfinished = overwrite_unfinished_;
    TURNSCAN_ASSIGN(auto rig, remote::RemoteRig::open(server_, session.context()));
    return remote::run_remote_capture(rig, request, session);
  }

  const CommandLine* line_ = nullptr;
  std::string server_;
#endif
  CaptureSetup setup_;
  std::string out_, resume_, report_;
  bool overwrite_unfinished_ = false;
};

}  // namespace

std::unique_ptr<Command> make_capture_command() { return std::make_unique<CaptureCommand>(); }

}  // namespace turnscan::cli
