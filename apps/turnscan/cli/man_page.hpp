#pragma once

#include <string>
#include <vector>

#include "cli/reference_page.hpp"

namespace turnscan::cli {

/// turnscan.1, in man macros.
std::string man_page(const std::vector<CommandReference>& commands);

}  // namespace turnscan::cli
