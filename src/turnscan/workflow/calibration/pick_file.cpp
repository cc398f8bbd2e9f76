#include <turnscan/workflow/calibration/pick_file.hpp>

#include <algorithm>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/table_text.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::workflow {

namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;

/// Where the columns are that give a point, and the scale of x, y and z.
struct PickColumns {
  char delimiter = ',';
  std::vector<std::string> names;
  std::vector<std::size_t> positions;  ///< x, y, z or column, row
  double scale = 1.0;

  bool pixels() const { return positions.size() == 2; }
};

Result<PickColumns> parse_columns(const std::string& path, std::string_view line) {
  PickColumns out;
  out.delimiter = text::delimiter_of(line);
  TURNSCAN_ASSIGN(out.names, text::csv_fields(line, out.delimiter));
  const auto take = [&](std::initializer_list<const char*> bases, std::string_view unit) {
    out.positions.clear();
    for (const char* base : bases) {
      const auto at = std::find_if(out.names.begin(), out.names.end(), [&](const auto& name) {
        const text::ColumnName column = text::column_name(name);
        return column.base == base && column.unit == unit;
      });
      if (at == out.names.end()) return false;
      out.positions.push_back(std::size_t(at - out.names.begin()));
    }
    return true;
  };
  if (take({"x", "y", "z"}, "m")) return out;
  out.scale = 1e-3;
  if (take({"x", "y", "z"}, "mm")) return out;
  out.scale = 1.0;
  if (take({"column", "row"}, "")) return out;
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
  TURNSCAN_ASSIGN(const auto fields, text::csv_fields(line, c.delimiter));
  Vec3d v = Vec3d::Zero();
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    const std::size_t at = c.positions[i];
    const auto value = text::parse_decimal(at < fields.size() ? fields[at] : "");
    if (!value)
      return fail(ErrorCode::kFormat, "column {}: {}", c.names[at], value.error().message);
    v[int(i)] = *value;
  }
  if (!c.pixels()) return Vec3d(c.scale * v);
  if (scan == nullptr || std::abs(v.x()) > 1e6 || std::abs(v.y()) > 1e6)
    return fail(ErrorCode::kMissingData, "pixel {}, {} has no depth", v.x(), v.y());
  return pixel_point(*scan, v.x(), v.y());
}

Result<std::string> read_table(const std::string& path) {
  TURNSCAN_ASSIGN(const std::string bytes, read_file(path, kMaxBytes));
  auto text = text::utf8_of(bytes);
  if (!text) return fail_at(path, text.error().code, "{}", text.error().message);
  return text;
}

}  // namespace

Result<bool> picks_pixels(const std::string& path) {
  TURNSCAN_ASSIGN(const std::string text, read_table(path));
  text::LineReader lines(text);
  const auto first = lines.next_content();
  if (!first) return fail_at(path, ErrorCode::kFormat, "the file of points is empty; fill it");
  TURNSCAN_ASSIGN(const PickColumns columns, parse_columns(path, first->text));
  return columns.pixels();
}

Result<std::vector<Vec3d>> read_picks(const std::string& path, const AveragedScan* scan) {
  TURNSCAN_ASSIGN(const std::string text, read_table(path));
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
