#pragma once
// Command-line arguments shared by turnscan capture, scan and serve.

#include <functional>
#include <string>
#include <turnscan/workflow/scan/capture_setup.hpp>
#include <turnscan/workflow/scan/scan.hpp>
#include <vector>

#include "cli/command.hpp"

namespace turnscan::cli {

class CommandLine;

/// Help of --resume.
inline constexpr const char* kResumeHelp =
    "Go on with this recording, which was ended early. Give the options with which it was begun";

/// All options of a setup except --device, limits, speed and crop.
void declare_capture(CommandLine& line, CaptureSetup& setup);

/// What turnscan scan and turnscan serve share: those, and whether to wait and what to write.
void declare_scan(CommandLine& line, ScanRequest& request, bool& no_wait);

/// Speed and crop, whose names collide with those of stages in turnscan scan.
void declare_table(CommandLine& line, CaptureSetup& setup);

/// The input files: recordings of "replay:" devices, and another file (may be empty).
std::vector<std::string> with_replayed(const std::vector<std::string>& devices,
                                       const std::string& file);

/// Callback that shows a capture's progress in the session.
std::function<void(const CaptureProgress&)> progress_in(Session& session);

}  // namespace turnscan::cli
