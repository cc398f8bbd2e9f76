#pragma once
// The stages of a reconstruction on the command line.

#include <turnscan/reconstruction/options.hpp>

#include "cli/command.hpp"

namespace turnscan::cli {

class CommandLine;

/// A group of options for each stage. options must outlive line.
void declare_stages(CommandLine& line, ReconstructOptions& options);

/// --help lists what the chosen method uses.
HelpScope stages_help_scope(const ReconstructOptions& options);

}  // namespace turnscan::cli
