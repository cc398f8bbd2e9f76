#pragma once
// What capture() is asked for.

#include <turnscan/capture/session/capture.hpp>

namespace turnscan::session {

/// Fails with kInvalidOption where a value is out of range or options contradict each other.
Result<> check_capture_options(const CaptureOptions& options, bool has_motor);

}  // namespace turnscan::session
