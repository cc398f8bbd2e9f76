#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace turnscan::cli {

struct CommandReference {
  std::string name;
  std::string help;
  std::vector<ArgumentGroup> groups;
};

/// docs/reference.md: every command with its arguments and options, as Markdown.
std::string reference_page(const std::vector<CommandReference>& commands);

}  // namespace turnscan::cli
