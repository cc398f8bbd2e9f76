#pragma once
// Outputs are checked before the work begins: nobody wants to learn after an hour that the folder
// does not exist.

#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Succeeds when a file with this ending (".json") can be written there. Fails with kInvalidOption
/// for another ending or a folder of that name, with kNotFound or kIo when its folder is missing or
/// not writable. An empty path (nothing is to be written) succeeds.
Result<> check_output_file(const std::string& path, const std::string& ending);

/// Succeeds when a folder can be made there: nothing has the name, or it is an empty folder. Fails
/// with kAlreadyExists (of an unfinished recording it says how to go on) or kIo. With
/// overwrite_unfinished an unfinished recording may lie there.
Result<> check_output_folder(const std::string& path, bool overwrite_unfinished = false);

/// The same, and with overwrite_unfinished it removes the unfinished recording that lies there: not
/// before all else that could fail has been done.
Result<> clear_output_folder(const std::string& path, bool overwrite_unfinished);

/// The path with a suffix before its ending: "dir/bear.ply", "-2" -> "dir/bear-2.ply".
std::string with_suffix(const std::string& path, const std::string& suffix);

/// Lower-case ending of the file name with its dot; empty if there is none.
std::string ending_of(const std::string& path);

}  // namespace turnscan
