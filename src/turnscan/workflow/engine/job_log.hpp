#pragma once

#include <filesystem>
#include <string>

namespace turnscan::engine {

/// The last line of a job's output that is not empty, or the name of the file where there is none.
std::string last_line_of(const std::filesystem::path& log);

}  // namespace turnscan::engine
