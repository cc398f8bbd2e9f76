#pragma once

#include <string>
#include <vector>

#include "cli/command_line.hpp"

namespace turnscan::cli {

struct CommandReference {
  std::string name;
  std::string help;
  std::vector<ArgumentGroup> groups;
};

/// A kind of TOML file written by users.
struct FileReference {
  std::string title;
  std::string help;
  std::vector<ArgumentGroup> groups;  ///< see keys_of(); without a name: top-level keys
};

/// docs/reference/options.md: every command with its arguments and options, then the files, as
/// Markdown.
std::string reference_page(const std::vector<CommandReference>& commands,
                           const std::vector<FileReference>& files);

}  // namespace turnscan::cli
