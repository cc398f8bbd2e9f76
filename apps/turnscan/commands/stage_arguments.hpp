#pragma once
// Options of the reconstruction's stages on the command line.

#include <turnscan/reconstruction/options.hpp>

namespace turnscan::cli {

class CommandLine;

/// Adds a group of options for each stage. options must outlive line.
void declare_stages(CommandLine& line, ReconstructOptions& options);

}  // namespace turnscan::cli
