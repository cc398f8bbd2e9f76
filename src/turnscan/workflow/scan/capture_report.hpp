#pragma once

#include <string>
#include <turnscan/capture/session/capture.hpp>

namespace turnscan {

/// A JSON object with what was recorded into the folder and what was lost; it ends with a line
/// break.
std::string capture_report(const CaptureResult& result, const SourceInfo& source,
                           const std::string& folder);

}  // namespace turnscan
