#pragma once
// Is a file whole? Looked at without decoding it.

#include <filesystem>
#include <string>

namespace turnscan::recording_format {

/// Empty when the file is there and looks whole, else the reason in a few words. PNG: ends with
/// IEND. JPEG: ends with the end-of-image marker. PLY: not shorter than its header says. Files
/// with other endings need only be there and not be empty.
std::string defect_of_file(const std::filesystem::path& path);

}  // namespace turnscan::recording_format
