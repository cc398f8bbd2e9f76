#include "commands/stage_arguments.hpp"

#include <utility>

#include "cli/command_line.hpp"

namespace turnscan::cli {

void declare_stages(CommandLine& line, ReconstructOptions& options) {
  for (OptionGroup& stage : describe_stages(options))
    line.group(stage.name, "Stage " + stage.name, std::move(stage.table));
}

}  // namespace turnscan::cli
