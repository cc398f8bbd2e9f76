#pragma once

#include <string>
#include <turnscan/io/file/folder.hpp>

namespace turnscan::engine {

/// The last non-empty line of a job's output, or the name of the file if there is none.
std::string last_line_of(const file::Folder& folder, const std::string& log);

}  // namespace turnscan::engine
