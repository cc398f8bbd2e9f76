#pragma once

#include <string>
#include <turnscan/capture/session/capture.hpp>

namespace turnscan {

/// "312 frames, 10.4 s, 0.34 turns, 0 dropped, 12.3 GB free"
std::string progress_text(const CaptureProgress& progress);

/// Several lines: what was recorded, what was lost and where, and the load.
std::string capture_text(const CaptureResult& result, const std::string& folder);

}  // namespace turnscan
