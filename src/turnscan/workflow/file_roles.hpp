#pragma once
// No output takes the place of an input: asked before the work begins, for every command.

#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// The files and folders that a run reads, and the files that it writes. Names of what is no file
/// ("builtin:cube", a device, empty) may be among them.
struct FileRoles {
  std::vector<std::string> inputs;   ///< a folder stands for every file in it
  std::vector<std::string> outputs;  ///< none is a folder
  std::string numbered{};  ///< one of the outputs, of which several objects make OUT-1, OUT-2, ...,
                           ///< and passes that do not fit OUT-pass2, ...; may be empty
  std::string removed{};   ///< a folder that is emptied before the work; may be empty
};

/// Fails with kInvalidOption when an output is an input, two outputs are one file, by whatever
/// names (links, device and inode; those of several objects included), or an input lies in the
/// folder that is emptied.
Result<> check_file_roles(const FileRoles& roles);

}  // namespace turnscan
