#include <filesystem>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/simulation/coverage_file.hpp>
#include <turnscan/workflow/simulation/coverage_sweep.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>
#include <turnscan/workflow/simulation/simulation_text.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::string_view kEmptyTable = "builtin:empty";

class SimulateCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.optional_positional(
        "OBJECT", object_,
        fmt::format("Object on the turntable: a mesh file, {}{}, or {} for the table alone",
                    kBuiltin, fmt::join(builtin_object_names(), fmt::format(", {}", kBuiltin)),
                    kEmptyTable));
    line.option("-o,--out", "RECORDING", request_.recording,
                "Folder to create for the recording; if it exists, it must be empty");
    line.flag("--overwrite-unfinished", request_.overwrite_unfinished, kOverwriteUnfinishedHelp);
    line.repeatable(
        "--scanner", "SCANNER", scanners_,
        fmt::format(
            "A preset ({}) or a file FILE.toml; may be given several times. Its own place and "
            "keys of its file follow after commas: kinect-v2,azimuth=90deg,far=2m (default: "
            "kinect-v2)",
            fmt::join(scanner_presets(), ", ")));
    line.repeatable("--next-pass", "NAME=VALUE,...", next_passes_,
                    "Add a pass to the recording: how the object lies in it, by the options of the "
                    "object, e.g. tip=90deg,yaw=30deg; may be given several times");
    line.option("--unit", "UNIT", unit_, "Unit of OBJECT if its file does not say it: mm, m, ...");
    line.option("--coverage", "FILE.ply", request_.coverage,
                "Write the coverage of the object, and why parts were missed: a coloured mesh, and "
                "FILE.json beside it. Without --out nothing is recorded");
    line.option("--sweep", "NAME=FROM..TO/STEP", sweep_,
                "Print the coverage for each value of a number of the scene, and the best: e.g. "
                "roll=-45deg..45deg/10deg. Nothing is recorded");
    line.option("--coverage-plot", "FILE.svg", plot_, "Write the coverage of --sweep as a plot");
    line.flag("--samples", request_.samples,
              "Also write the true value of every sample to RECORDING/truth/samples");
    line.option("--report", "FILE.json", request_.report,
                "Write what was done as JSON: options, counts, times");
    line.file_option(
        "--scene", "FILE.toml",
        "Read everything from a TOML file: the tables below, [[scanner]], [[pass]] and the "
        "object. The command line takes precedence over the file",
        [this](const std::string& path) { return read_scene(path, request_.scene); });
    for (SceneTable& table : describe(request_.scene))
      line.group(table.name, table.title, std::move(table.options));
    line.group("coverage", "Coverage", describe(request_.coverage_options));
    line.common({"out", "scanner", "frames", "turns", "height", "distance", "elevation", "noise",
                 "next-pass", "scan-colour", "coverage", "scene"});
  }

  FileRoles files() const override {
    FileRoles files{{object_, request_.scene.object}, {request_.coverage, request_.report, plot_}};
    if (request_.overwrite_unfinished) files.removed = request_.recording;
    if (!request_.coverage.empty()) files.outputs.push_back(coverage_json_file(request_));
    for (const std::string& text : scanners_)
      files.inputs.push_back(text.substr(0, text.find(',')));
    for (const ScannerEntry& entry : request_.scene.scanners) files.inputs.push_back(entry.model);
    return files;
  }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(take_arguments());
    TURNSCAN_TRY(check_something_is_made());
    if (!sweep_.empty()) return sweep(session);
    session.plan(simulate_phases(request_));
    TURNSCAN_ASSIGN(const Simulation made, simulate(request_, session.context()));
    if (!request_.recording.empty()) tell_recording(made, session);
    if (made.coverage) tell_coverage(*made.coverage, session);
    return {};
  }

 private:
  Result<> take_arguments() {
    if (!object_.empty()) request_.scene.object = object_;
    if (!unit_.empty()) request_.scene.unit = unit_;
    if (request_.scene.object.empty())
      return fail(ErrorCode::kInvalidOption,
                  "OBJECT: missing; give a mesh file, a built-in object or a scene that names one");
    if (!next_passes_.empty()) request_.scene.next_passes.clear();
    for (const std::string& text : next_passes_) {
      TURNSCAN_ASSIGN(PassEntry pass, parse_pass_entry(text));
      request_.scene.next_passes.push_back(std::move(pass));
    }
    if (scanners_.empty()) return {};
    request_.scene.scanners.clear();
    for (const std::string& text : scanners_) {
      TURNSCAN_ASSIGN(ScannerEntry entry, parse_scanner_entry(text));
      request_.scene.scanners.push_back(std::move(entry));
    }
    return {};
  }

  Result<> check_something_is_made() const {
    if (sweep_.empty() && !plot_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--coverage-plot: there is nothing to plot; give --sweep NAME=FROM..TO/STEP");
    if (!sweep_.empty() && (!request_.recording.empty() || !request_.coverage.empty()))
      return fail(ErrorCode::kInvalidOption,
                  "--sweep: it compares scans and makes none; leave out --out and --coverage");
    if (!sweep_.empty() && (!request_.report.empty() || request_.samples))
      return fail(ErrorCode::kInvalidOption,
                  "--sweep: it only prints the coverage; leave out --report and --samples");
    if (!sweep_.empty() || !request_.recording.empty() || !request_.coverage.empty()) return {};
    return fail(ErrorCode::kInvalidOption,
                "--out: missing; give the folder to make, or --coverage FILE.ply");
  }

  Result<> sweep(Session& session) {
    TURNSCAN_TRY(check_output_file(plot_, ".svg"));
    const auto range = parse_sweep_range(sweep_, request_.scene);
    if (!range) return fail(ErrorCode::kInvalidOption, "--sweep: {}", range.error().message);
    TURNSCAN_ASSIGN(const auto swept, sweep_coverage(request_.scene, *range,
                                                     request_.coverage_options, session.context()));
    session.print("{}", sweep_text(*range, swept));
    if (plot_.empty()) return {};
    TURNSCAN_TRY(write_file_atomically(plot_, sweep_svg(*range, swept)));
    session.print("Wrote {}\n", plot_);
    return {};
  }

  void tell_recording(const Simulation& made, Session& session) const {
    session.print("{}", simulation_text(made));
    session.print("Wrote {} and the truth in {}\n", request_.recording,
                  (std::filesystem::path(request_.recording) / "truth").string());
    if (!request_.report.empty()) session.print("Wrote {}\n", request_.report);
  }

  void tell_coverage(const CoverageMap& map, Session& session) const {
    session.print("{}", coverage_text(map, request_.coverage_options));
    session.print("Wrote {} and {}\n", request_.coverage, coverage_json_file(request_));
  }

  std::string object_, unit_, sweep_, plot_;
  std::vector<std::string> scanners_, next_passes_;
  SimulateRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_simulate_command() { return std::make_unique<SimulateCommand>(); }

}  // namespace turnscan::cli
