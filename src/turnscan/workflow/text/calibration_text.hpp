#pragma once

#include <string>
#include <turnscan/core/calibration.hpp>

namespace turnscan {

/// Figures with their standard deviations and how they were found, for people.
std::string calibration_text(const Calibration& calibration);

}  // namespace turnscan
