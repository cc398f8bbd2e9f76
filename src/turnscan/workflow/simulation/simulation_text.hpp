#pragma once

#include <string>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

/// What became of each scanner's samples, and how long it took, for people.
std::string simulation_text(const Simulation& simulation);

}  // namespace turnscan
