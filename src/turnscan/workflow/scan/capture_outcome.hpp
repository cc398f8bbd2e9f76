#pragma once

#include <string>
#include <turnscan/capture/session/capture.hpp>

namespace turnscan {

/// Succeeds if the recording in `folder` is complete. Else fails with the error that ended it early
/// (kCancelled if it was stopped), or kMissingData if there is no frame; the message says what the
/// folder contains and whether it needs repair.
Result<> capture_outcome(const CaptureResult& result, const std::string& folder);

}  // namespace turnscan
