#pragma once

#include <string>
#include <turnscan/core/result.hpp>

#include "serve/jobs.hpp"

namespace turnscan::serve {

/// A small JPEG of what the sensor sees: its colours, or else its depth as greys, near is bright.
/// Fails as encode_color_jpeg().
Result<std::string> live_picture(const LiveFrame& frame);

}  // namespace turnscan::serve
