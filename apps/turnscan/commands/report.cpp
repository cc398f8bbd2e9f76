#include <filesystem>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/inspection/element_file.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

namespace fs = std::filesystem;

class ReportCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional(
        "MESH|RECORDING", path_,
        "Mesh to show, or recording (or file or folder of another program, see turnscan "
        "import), which is reconstructed as turnscan reconstruct does without options");
    line.repeatable("--import", "NAME=VALUE", import_, kImportOptionsHelp);
    line.required_option("-o,--out", "FILE.html", out_, "Page to write");
    line.option("--made-by", "FILE.json", report_,
                "What reconstruct or scan wrote about the mesh with --report: verdict, parameters "
                "with their reasons, notes");
    line.option("--reference", "MESH", reference_,
                "The true surface: the page then shows the deviation from it");
    line.option("--elements", "FILE.json", elements_,
                "Elements to fit to the (first) object, see turnscan evaluate: the page then has "
                "their figures");
    line.option("--title", "TEXT", title_, "Title of the page, by default the name of the input");
    line.allow_config();
    line.group("evaluation", "Comparison with the reference", describe(evaluate_));
    line.common({"out", "made-by", "reference", "title", "align", "thresholds", "tolerance",
                 "import", "elements"});
  }

  FileRoles files() const override { return {{path_, report_, reference_, elements_}, {out_}}; }

  Result<> run(Session& session) override {
    TURNSCAN_ASSIGN(const ReportFiles names, sort_report_files({out_}));
    if (names.page.empty())
      return fail_at(out_, ErrorCode::kInvalidOption, "the name must end in .html; rename it");
    TURNSCAN_TRY(check_report_files(names));
    TURNSCAN_TRY(file::check_exists(path_, "file or folder"));
    ElementPlan elements;
    if (!elements_.empty()) {
      TURNSCAN_ASSIGN(elements, workflow::read_elements(elements_, session.context()));
    }
    session.plan(page_phases());
    TURNSCAN_ASSIGN(PageInput input, read_input(session));
    if (!title_.empty()) input.title = title_;
    if (!reference_.empty()) {
      TURNSCAN_ASSIGN(const TriangleMesh reference, read_mesh(reference_, {}, session.context()));
      TURNSCAN_TRY(compare_with(input, reference, evaluate_, session.context()));
    }
    if (!elements_.empty() && !input.objects.empty()) {
      TURNSCAN_ASSIGN(input.elements,
                      measure_elements(input.objects.front().mesh, elements, session.context()));
    }
    TURNSCAN_ASSIGN(const ReportPage page, write_page(out_, input, session.context()));
    if (!page.has_viewer)
      session.print(
          "Note: the page has pictures, but no 3D view: this turnscan was built without it "
          "(scripts/setup page)\n");
    session.print("Wrote {} ({:.1f} MB)\n", out_, double(page.html.size()) / 1e6);
    return {};
  }

 private:
  Result<PageInput> read_input(Session& session) const {
    const fs::path path(path_);
    std::error_code error;
    const bool recording = !import_.empty() || fs::is_directory(path, error) ||
                           path.filename() == "recording.json" || is_foreign(path);
    if (recording && !report_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--made-by belongs to a mesh, and {} is a recording; leave it out", path_);
    return recording ? of_recording(session) : of_mesh(session.context());
  }

  Result<PageInput> of_recording(Session& session) const {
    TURNSCAN_ASSIGN(const Input input, open_input_asking(path_, import_, session.context()));
    const ReconstructRequest request;
    session.plan(joined({reconstruct_phases({{"", input.frames.get()}}, request), page_phases()}));
    TURNSCAN_ASSIGN(const ReconstructRun run,
                    run_reconstruction(*input.frames, request, session.context()));
    for (const std::string& note : input.notes) session.print("Note: {}\n", note);
    const fs::path folder = fs::path(path_).filename() == "recording.json"
                                ? fs::absolute(path_).parent_path()
                                : fs::absolute(path_).lexically_normal();
    const fs::path name = folder.has_filename() ? folder : folder.parent_path();
    return page_input(run, run_report(run, request.options), name.stem().string());
  }

  Result<PageInput> of_mesh(const RunContext& context) const {
    PageInput input;
    input.title = page_title(path_);
    TURNSCAN_ASSIGN(std::vector<TriangleMesh> meshes, read_meshes(path_, {}, context));
    for (TriangleMesh& mesh : meshes) {
      PageObject object;
      object.mesh = std::move(mesh);
      input.objects.push_back(std::move(object));
    }
    if (!report_.empty()) {
      TURNSCAN_ASSIGN(input.report, read_file(report_));
    }
    return input;
  }

  std::vector<std::string> import_;
  std::string path_, out_, report_, reference_, elements_, title_;
  EvaluateOptions evaluate_;
};

}  // namespace

std::unique_ptr<Command> make_report_command() { return std::make_unique<ReportCommand>(); }

}  // namespace turnscan::cli
