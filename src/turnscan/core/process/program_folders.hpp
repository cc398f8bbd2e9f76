#pragma once
// Folders from which a program may start or load code.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::process {

/// PREFIX/relative for a program in PREFIX/bin, and the build tree's folder for a program in it;
/// none for a program elsewhere. They need not exist.
std::vector<std::filesystem::path> own_folders(const std::filesystem::path& relative);

/// Folders named by an environment variable, if it is set. Fails with kInvalidOption for one that
/// is not absolute.
Result<std::vector<std::filesystem::path>> folders_of_variable(const char* name);

/// Succeeds if only the superuser, this user and those who could replace this program can have
/// replaced this file: it and all folders above it are owned by them, and not writable by others
/// (folders with the sticky bit may be), up to a folder that also contains the program. Fails with
/// kNoPermission, naming the offending path. Returns the path that was judged, without links: the
/// one to start or load.
Result<std::filesystem::path> trusted(const std::filesystem::path& path);

}  // namespace turnscan::process
