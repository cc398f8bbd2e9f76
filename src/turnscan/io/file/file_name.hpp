#pragma once
// Names of files.

#include <filesystem>
#include <string>

namespace turnscan::file {

/// Lower-case extension of a file name without the dot: "scan.PLY" -> "ply".
inline std::string lower_extension(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  if (!text.empty()) text.erase(0, 1);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace turnscan::file
