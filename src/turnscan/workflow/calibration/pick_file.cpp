#include <turnscan/workflow/calibration/pick_file.hpp>

#include <algorithm>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::workflow {

namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;

struct PickColumns {
  text::CsvColumns columns;
  bool pixels = false;
  double scale = 1.0;
};

Result<PickColumns> parse_columns(const std::string& path, std::string_view line) {
  auto columns = text::CsvColumns::parse(line);
  if (!columns) return fail_at(path, ErrorCode::kFormat, "line 1: {}", columns.error().message);
  const auto has = [&](const char* x, const char* y, const char* z) {
    return columns->has(x) && columns->has(y) && columns->has(z);
  };
  if (has("x_m", "y_m", "z_m")) return PickColumns{*columns, false, 1.0};
  if (has("x_mm", "y_mm", "z_mm")) return PickColumns{*columns, false, 1e-3};
  if (columns->has("column") && columns->has("row")) return PickColumns{*columns, true, 1.0};
  return fail_at(path, ErrorCode::kFormat,
                 "line 1 does not name the columns; write x_mm,y_mm,z_mm or x_m,y_m,z_m or "
                 "column,row");
}

/// Median depth of the valid pixels in the neighbourhood; the rim's own pixel may be mixed.
Result<Vec3d> pixel_point(const AveragedScan& scan, double column, double row) {
  std::vector<float> depths;
  const long x = std::lround(column), y = std::lround(row);
  for (long v = y - 1; v <= y + 1; ++v) {
    for (long u = x - 1; u <= x + 1; ++u) {
      if (u < 0 || v < 0 || u >= scan.depth_m.width || v >= scan.depth_m.height) continue;
      const float z = scan.depth_m.at(int(u), int(v));
      if (z > 0.0f) depths.push_back(z);
    }
  }
  if (depths.empty())
    return fail(ErrorCode::kMissingData, "pixel {}, {} has no depth", column, row);
  std::sort(depths.begin(), depths.end());
  // The nearer of the two middle ones: behind the rim is something else.
  return Vec3d(scan.intrinsics.ray(column, row) * double(depths[(depths.size() - 1) / 2]));
}

Result<Vec3d> parse_pick(const PickColumns& c, std::string_view line, const AveragedScan* scan) {
  TURNSCAN_ASSIGN(const auto fields, text::csv_fields(line));
  const auto number = [&](const char* name) -> Result<double> {
    auto value = parse_number(c.columns.field(fields, name));
    if (!value) return fail(ErrorCode::kFormat, "column {}: {}", name, value.error().message);
    return value;
  };
  if (c.pixels) {
    TURNSCAN_ASSIGN(const double column, number("column"));
    TURNSCAN_ASSIGN(const double row, number("row"));
    if (scan == nullptr || std::abs(column) > 1e6 || std::abs(row) > 1e6)
      return fail(ErrorCode::kMissingData, "pixel {}, {} has no depth", column, row);
    return pixel_point(*scan, column, row);
  }
  const bool metres = c.scale == 1.0;
  TURNSCAN_ASSIGN(const double x, number(metres ? "x_m" : "x_mm"));
  TURNSCAN_ASSIGN(const double y, number(metres ? "y_m" : "y_mm"));
  TURNSCAN_ASSIGN(const double z, number(metres ? "z_m" : "z_mm"));
  return Vec3d(c.scale * Vec3d(x, y, z));
}

}  // namespace

Result<bool> picks_pixels(const std::string& path) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxBytes));
  text::LineReader lines(text);
  const auto first = lines.next_content();
  if (!first) return fail_at(path, ErrorCode::kFormat, "the file of points is empty; fill it");
  TURNSCAN_ASSIGN(const PickColumns columns, parse_columns(path, first->text));
  return columns.pixels;
}

Result<std::vector<Vec3d>> read_picks(const std::string& path, const AveragedScan* scan) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxBytes));
  text::LineReader lines(text);
  const auto first = lines.next_content();
  if (!first) return fail_at(path, ErrorCode::kFormat, "the file of points is empty; fill it");
  TURNSCAN_ASSIGN(const PickColumns columns, parse_columns(path, first->text));
  std::vector<Vec3d> points;
  while (const auto line = lines.next_content()) {
    auto point = parse_pick(columns, line->text, scan);
    if (!point)
      return fail_at(path, ErrorCode::kFormat, "line {}: {}", line->number, point.error().message);
    points.push_back(*point);
  }
  return points;
}

}  // namespace turnscan::workflow
