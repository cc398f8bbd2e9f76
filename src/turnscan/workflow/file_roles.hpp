#pragma once
// Makes sure that no output overwrites an input; checked for every command before the work begins.

#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// Files and folders that a run reads, and files that it writes. Names that are not files
/// ("builtin:cube", a device, empty) are allowed.
struct FileRoles {
  std::vector<std::string> inputs;   ///< a folder stands for every file in it
  std::vector<std::string> outputs;  ///< none of them is a folder
  /// One of the outputs, which is written as OUT-1, OUT-2, ... for several objects, and as
  /// OUT-pass2, ... for passes that do not fit; may be empty.
  std::string numbered{};
  std::string removed{};  ///< a folder that is emptied before the work begins; may be empty
};

/// Fails with kInvalidOption if an output is an input, if two outputs are the same file under any
/// names (links, device and inode; including the numbered files), or if an input is inside the
/// folder that is emptied.
Result<> check_file_roles(const FileRoles& roles);

}  // namespace turnscan
