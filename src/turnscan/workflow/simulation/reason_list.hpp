#pragma once

#include <string>

namespace turnscan::workflow {

/// "0 none, 1 nothing, ...": the numbers of Miss, for the headers of files.
std::string reason_list();

}  // namespace turnscan::workflow
