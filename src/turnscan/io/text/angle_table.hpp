#pragma once
// Tables of the angles, times or poses of scans and images.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::text {

struct AngleRow {
  std::size_t line = 0;
  std::string file;
  std::optional<double> angle_rad, time_s;
  std::optional<Pose> T_world_scan;
  std::uint32_t pass = 0, sensor = 0;
};

/// Columns file, and angle (in degrees, or as the unit says), time (in seconds, or as the unit
/// says) or tx, ty, tz (in metres, or as the unit says), qx, qy, qz and qw; pass and sensor may
/// follow, others are ignored. Separated by comma, semicolon or tabulator, in UTF-8 or UTF-16, with
/// decimal points or commas. Fails with kFormat.
Result<std::vector<AngleRow>> parse_angle_table(std::string_view bytes);

}  // namespace turnscan::text
