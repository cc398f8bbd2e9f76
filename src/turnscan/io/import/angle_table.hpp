#pragma once
// Tables of the angles or times of scans and images.

#include <filesystem>
#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::importers {

struct AngleRow {
  std::size_t line = 0;
  std::string file;
  std::optional<double> angle_rad, time_s;
  std::uint32_t pass = 0, sensor = 0;
};

/// Columns file, and angle (in degrees, or as the unit says) or time (in seconds, or as the unit
/// says); pass and sensor may follow, others are ignored. Separated by comma, semicolon or
/// tabulator, in UTF-8 or UTF-16, with decimal points or commas. Fails with kFormat, and as reading
/// does.
Result<std::vector<AngleRow>> read_angle_table(const std::filesystem::path& path);

}  // namespace turnscan::importers
