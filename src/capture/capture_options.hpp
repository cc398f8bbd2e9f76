#pragma once
// What capture() is asked for. Internal to capture: not installed.

#include <turnscan/capture/capture.hpp>

namespace turnscan {

/// Fails with kInvalidOption where a value is out of range or options contradict each other.
Result<> check_capture_options(const CaptureOptions& options, bool has_motor);

}  // namespace turnscan
