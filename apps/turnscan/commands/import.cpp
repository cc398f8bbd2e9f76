#include <turnscan/io/import/importers.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/summary.hpp>
#include <turnscan/workflow/input.hpp>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/text/text_table.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

class ImportCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.optional_positionals(
        "SOURCE...", sources_,
        "Data set to read: a folder or a file in a layout that --list shows. Several are passes of "
        "one object, which is laid differently in each");
    line.option("-o,--out", "RECORDING", out_,
                "Folder to create for the recording; if it exists, it must be empty");
    line.flag("--list", list_, "Print the layouts that can be imported, and do nothing else");
    line.flag("--overwrite-unfinished", overwrite_unfinished_, kOverwriteUnfinishedHelp);
    line.allow_config();
    line.group("import", "Import", describe(options_));
    line.common({"out", "format", "angles", "speed", "intrinsics", "depth-unit", "fps", "clockwise",
                 "turntable-axis", "sensor-position", "config"});
  }

  FileRoles files() const override {
    return {sources_, {}, {}, overwrite_unfinished_ ? out_ : std::string()};
  }

  Result<> run(Session& session) override {
    if (list_) {
      session.print("{}", layouts_text());
      return {};
    }
    for (const auto& [name, given] :
         {std::pair("SOURCE", !sources_.empty()), {"--out", !out_.empty()}})
      if (!given) return fail(ErrorCode::kInvalidOption, "{}: missing; give it", name);
    TURNSCAN_TRY(options_.check());
    TURNSCAN_TRY(check_output_folder(out_, overwrite_unfinished_));
    TURNSCAN_ASSIGN(const auto sequence, open_foreign_passes({sources_.begin(), sources_.end()},
                                                             options_, session.context()));
    TURNSCAN_TRY(check_assumptions(*sequence, options_, session.context()));
    TURNSCAN_TRY(clear_output_folder(out_, overwrite_unfinished_));
    session.plan({{"write recording", 30.0}, {"look at frames", 1.0}});
    TURNSCAN_TRY(write_recording(out_, *sequence, session.context()));
    TURNSCAN_ASSIGN(const Input made, open_input(out_));
    TURNSCAN_ASSIGN(const SequenceSummary summary, summarize(made, session.context()));
    session.print("{}Wrote {}\n", summary_text(summary), out_);
    return {};
  }

 private:
  static std::string layouts_text() {
    workflow::TextTable table({0, 1});
    table.add({"format", "layout"});
    for (const ImporterInfo& importer : importer_list())
      table.add({std::string(importer.name), std::string(importer.help)});
    return table.text();
  }

  std::vector<std::string> sources_;
  std::string out_;
  bool list_ = false, overwrite_unfinished_ = false;
  ImportOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_import_command() { return std::make_unique<ImportCommand>(); }

}  // namespace turnscan::cli
