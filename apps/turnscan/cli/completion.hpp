#pragma once
// Shell completions, from the same tables as the reference page.

#include <string>
#include <vector>

#include "cli/reference_page.hpp"

namespace turnscan::cli {

std::string bash_completion(const std::vector<CommandReference>& commands);
std::string zsh_completion(const std::vector<CommandReference>& commands);
std::string fish_completion(const std::vector<CommandReference>& commands);

}  // namespace turnscan::cli
