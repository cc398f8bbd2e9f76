#pragma once
// The name of this machine.

#include <string>

namespace turnscan::process {

/// As the system has it; empty if it has none.
std::string host_name();

}  // namespace turnscan::process
