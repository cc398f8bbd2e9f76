#pragma once
// Checks outputs before the work begins, so that an invalid path is reported at once and not after
// an hour.

#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Succeeds if a file with this extension (".json") can be written at the path. Fails with
/// kInvalidOption for another extension or a folder of that name, with kNotFound or kIo if the
/// parent folder is missing or not writable. An empty path (nothing is to be written) succeeds.
Result<> check_output_file(const std::string& path, const std::string& ending);

/// Succeeds if the folder can be created: it does not exist, or it is an empty folder. Fails with
/// kAlreadyExists (for an unfinished recording the message says how to continue) or kIo. With
/// overwrite_unfinished the folder may contain an unfinished recording.
Result<> check_output_folder(const std::string& path, bool overwrite_unfinished = false);

/// The same, and with overwrite_unfinished removes the unfinished recording, after everything else
/// that could fail has succeeded.
Result<> clear_output_folder(const std::string& path, bool overwrite_unfinished);

/// The path with a suffix before its extension: "dir/bear.ply", "-2" -> "dir/bear-2.ply".
std::string with_suffix(const std::string& path, const std::string& suffix);

/// Lower-case extension of the file name including the dot; empty if there is none.
std::string ending_of(const std::string& path);

}  // namespace turnscan
