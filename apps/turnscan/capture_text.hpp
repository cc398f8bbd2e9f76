#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <turnscan/capture/capture.hpp>

#include "capture_outcome.hpp"
#include "command.hpp"

namespace turnscan::cli {

/// "312 frames, 0.34 turns, 0 dropped, 12.3 GB free"
std::string progress_text(const CaptureProgress& progress);

/// Shows a capture's progress in the session.
std::function<void(const CaptureProgress&)> progress_in(Session& session);

/// Several lines: what was recorded, what was lost and where, how hard it was.
std::string capture_text(const CaptureResult& result, const std::string& folder);
nlohmann::ordered_json capture_json(const CaptureResult& result, const SourceInfo& source);

}  // namespace turnscan::cli
