#pragma once
// Where the code that a program starts or loads may come from.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::process {

/// PREFIX/relative for a program in PREFIX/bin, and the build tree's for a program in it; none
/// for a program elsewhere. They need not exist.
std::vector<std::filesystem::path> own_folders(const std::filesystem::path& relative);

/// The value of an environment variable that names folders, where it is set. Fails with
/// kInvalidOption for one that is not absolute.
Result<std::vector<std::filesystem::path>> folders_of_variable(const char* name);

/// Succeeds when nobody but the superuser, this user and those who could replace this program can
/// have put something else in the place of this file: it and all folders above it are theirs, and
/// not writable by others (folders with the sticky bit may be), up to a folder in which the program
/// lies, too. Fails with kNoPermission, naming what is not so.
Result<> check_trusted(const std::filesystem::path& path);

}  // namespace turnscan::process
