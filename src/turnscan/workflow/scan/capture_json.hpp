#pragma once

#include <nlohmann/json_fwd.hpp>
#include <turnscan/capture/session/capture.hpp>

namespace turnscan::workflow {

/// capture_report() without program and folder, for embedding in other reports.
nlohmann::ordered_json capture_json(const CaptureResult& result, const SourceInfo& source);

}  // namespace turnscan::workflow
