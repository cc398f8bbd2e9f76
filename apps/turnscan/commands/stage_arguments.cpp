#include "commands/stage_arguments.hpp"

#include <utility>

#include "cli/command_line.hpp"

namespace turnscan::cli {

void declare_stages(CommandLine& line, ReconstructOptions& options) {
  for (OptionGroup& stage : describe_stages(options))
    line.group(stage.name, "Stage " + stage.name, std::move(stage.table));
}

HelpScope stages_help_scope(const ReconstructOptions& options) {
  ReconstructOptions copy = options;
  const OptionTable table = describe(copy);
  const OptionField& method = *table.find("method");
  std::vector<std::string> others = method.choices;
  std::erase(others, method.get());
  return {options_of_others(options.surface.method),
          fmt::format("Options that --method {} does not use are left out; --method {} --help "
                      "lists those of the other methods.",
                      method.get(), fmt::join(others, " or "))};
}

}  // namespace turnscan::cli
