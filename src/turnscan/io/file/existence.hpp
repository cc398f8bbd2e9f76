#pragma once
// Distinguishes missing paths from inaccessible ones.

#include <filesystem>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::file {

/// Whether the path exists, following symbolic links. Fails with kIo and the system's message if
/// that cannot be determined: an inaccessible path is not a missing one.
Result<bool> is_there(const std::filesystem::path& path);

/// Fails with kNotFound if nothing exists there, and as is_there(). what: "file", "folder".
Result<> check_exists(const std::filesystem::path& path, std::string_view what);

}  // namespace turnscan::file
