#pragma once
// What turnscan capture and turnscan scan have in common on the command line.

#include <functional>
#include <turnscan/workflow/scan/capture_setup.hpp>

#include "cli/command.hpp"

namespace turnscan::cli {

class CommandLine;

/// All options of a setup but --device, limits, speed and crop.
void declare_capture(CommandLine& line, CaptureSetup& setup);

/// Speed and crop, whose names are those of stages in turnscan scan.
void declare_table(CommandLine& line, CaptureSetup& setup);

/// Shows a capture's progress in the session.
std::function<void(const CaptureProgress&)> progress_in(Session& session);

}  // namespace turnscan::cli
