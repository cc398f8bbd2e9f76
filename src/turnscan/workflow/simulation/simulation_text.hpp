#pragma once

#include <string>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

/// Statistics of each scanner's samples, and times, human-readable.
std::string simulation_text(const Simulation& simulation);

}  // namespace turnscan
