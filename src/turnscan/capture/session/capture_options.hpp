#pragma once
// Validates the options of capture().

#include <turnscan/capture/session/capture.hpp>

namespace turnscan::session {

/// Fails with kInvalidOption if a value is out of range or options contradict each other.
Result<> check_capture_options(const CaptureOptions& options, bool has_motor);

}  // namespace turnscan::session
