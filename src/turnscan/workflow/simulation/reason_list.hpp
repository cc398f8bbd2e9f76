#pragma once

#include <string>

namespace turnscan::workflow {

/// "0 none, 1 nothing, ...": the numeric values of Miss, for file headers.
std::string reason_list();

}  // namespace turnscan::workflow
