#pragma once
// What turnscan capture and turnscan scan have in common on the command line.

#include <functional>
#include <string>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <vector>

#include "cli/command.hpp"

namespace turnscan::cli {

class CommandLine;

/// All options of a setup but --device, limits, speed and crop.
void declare_capture(CommandLine& line, CaptureSetup& setup);

/// Speed and crop, whose names are those of stages in turnscan scan.
void declare_table(CommandLine& line, CaptureSetup& setup);

/// The files among what is read: recordings of "replay:" devices, and another one (may be empty).
std::vector<std::string> with_replayed(const std::vector<std::string>& devices,
                                       const std::string& file);

/// Shows a capture's progress in the session.
std::function<void(const CaptureProgress&)> progress_in(Session& session);

}  // namespace turnscan::cli
