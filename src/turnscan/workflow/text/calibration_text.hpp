#pragma once

#include <string>
#include <turnscan/core/calibration.hpp>

namespace turnscan {

/// Parameters with their standard deviations and the method that found them, human-readable.
std::string calibration_text(const Calibration& calibration);

}  // namespace turnscan
