#pragma once
// What is missing, and what only cannot be looked at.

#include <filesystem>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::file {

/// Whether anything lies there, symbolic links followed. Fails with kIo, in the system's words,
/// where that cannot be told: what may not be looked at is not missing.
Result<bool> is_there(const std::filesystem::path& path);

/// Fails with kNotFound where nothing lies, and as is_there(). what: "file", "folder".
Result<> check_exists(const std::filesystem::path& path, std::string_view what);

}  // namespace turnscan::file
