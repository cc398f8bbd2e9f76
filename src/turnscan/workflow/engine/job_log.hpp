#pragma once

#include <filesystem>
#include <string>

namespace turnscan::engine {

/// The last non-empty line of a job's output, or the name of the file if there is none.
std::string last_line_of(const std::filesystem::path& log);

}  // namespace turnscan::engine
