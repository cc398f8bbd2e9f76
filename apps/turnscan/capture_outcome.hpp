#pragma once

#include <string>
#include <turnscan/capture/capture.hpp>

namespace turnscan::cli {

/// The result as the command's: an error that says what the recording holds; {} for a good end.
Result<> outcome_of(const CaptureResult& result, const std::string& folder);

}  // namespace turnscan::cli
