#pragma once

#include <string>
#include <turnscan/capture/session/capture.hpp>

namespace turnscan {

/// Succeeds when the recording in `folder` came to its end. Else fails with what ended it too early
/// (kCancelled when it was stopped), or kMissingData without any frame; the message says what the
/// folder holds and whether it has to be repaired.
Result<> capture_outcome(const CaptureResult& result, const std::string& folder);

}  // namespace turnscan
