#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/recording/frames_csv.hpp>

namespace turnscan::recording_format {

namespace {

constexpr std::size_t kMaxFrames = 1000000;
constexpr std::uint32_t kMaxIndex = 4000000000;
constexpr std::array<const char*, 7> kPoseColumns{"tx", "ty", "tz", "qx", "qy", "qz", "qw"};

/// Trailing zeros are dropped. Degrees get ten decimals: an angle of a few thousand degrees that is
/// read and written again keeps its text although it is converted to radians.
std::string fixed_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

Result<double> number_field(const text::CsvColumns& columns, const std::vector<std::string>& fields,
                            const char* name) {
  auto value = parse_number(columns.field(fields, name));
  if (!value) return fail(ErrorCode::kFormat, "column {}: {}", name, value.error().message);
  return value;
}

Result<std::uint32_t> index_field(const text::CsvColumns& columns,
                                  const std::vector<std::string>& fields, const char* name,
                                  std::uint32_t max) {
  const std::string_view text = columns.field(fields, name);
  if (text.empty() && std::string_view(name) != "index") return 0U;
  auto value = text::parse_index(text, max);
  if (!value) return fail(ErrorCode::kFormat, "column {}: {}", name, value.error().message);
  return value;
}

Result<std::optional<Pose>> pose_fields(const text::CsvColumns& columns,
                                        const std::vector<std::string>& fields) {
  const auto given = std::count_if(kPoseColumns.begin(), kPoseColumns.end(), [&](const char* name) {
    return !columns.field(fields, name).empty();
  });
  if (given == 0) return std::optional<Pose>();
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    TURNSCAN_ASSIGN(v[i], number_field(columns, fields, kPoseColumns[i]));
  }
  TURNSCAN_ASSIGN(const Pose pose, pose_from(Vec3d(v[0], v[1], v[2]), v[3], v[4], v[5], v[6]));
  return std::optional<Pose>(pose);
}

Result<FrameStatus> status_field(std::string_view text) {
  if (text.empty() || text == "ok") return FrameStatus::kOk;
  if (text == "dropped") return FrameStatus::kDropped;
  return fail(ErrorCode::kFormat, "column status: '{}' is neither ok nor dropped", text);
}

Result<std::string> name_field(std::string_view text) {
  if (!text.empty()) TURNSCAN_TRY(text::check_inside(text));
  return std::string(text);
}

Result<FrameRow> parse_row(const text::CsvColumns& columns, const text::TextLine& line,
                           std::size_t sensor_count) {
  TURNSCAN_ASSIGN(const std::vector<std::string> fields, text::csv_fields(line.text));
  if (fields.size() != columns.size())
    return fail(ErrorCode::kFormat, "there are {} fields, not {}", fields.size(), columns.size());
  FrameRow row;
  FrameInfo& info = row.info;
  row.line = line.number;
  TURNSCAN_ASSIGN(info.index, index_field(columns, fields, "index", kMaxIndex));
  TURNSCAN_ASSIGN(info.sensor, index_field(columns, fields, "sensor", kMaxIndex));
  if (info.sensor >= sensor_count)
    return fail(ErrorCode::kFormat, "sensor {} does not exist: recording.json describes {}",
                info.sensor, sensor_count);
  TURNSCAN_ASSIGN(info.pass, index_field(columns, fields, "pass", kMaxIndex));
  TURNSCAN_ASSIGN(info.turn, index_field(columns, fields, "turn", kMaxIndex));
  if (!columns.field(fields, "time_s").empty()) {
    TURNSCAN_ASSIGN(info.time_s, number_field(columns, fields, "time_s"));
  }
  if (!columns.field(fields, "angle_deg").empty()) {
    TURNSCAN_ASSIGN(const double degrees, number_field(columns, fields, "angle_deg"));
    info.angle_rad = degrees * kRadiansPerDegree;
  }
  TURNSCAN_ASSIGN(info.T_table_sensor, pose_fields(columns, fields));
  if (const std::string why = implausible(info); !why.empty())
    return fail(ErrorCode::kFormat, "frame {}: {}", info.index, why);
  TURNSCAN_ASSIGN(info.file, name_field(columns.field(fields, "file")));
  TURNSCAN_ASSIGN(row.color_file, name_field(columns.field(fields, "color_file")));
  TURNSCAN_ASSIGN(info.status, status_field(columns.field(fields, "status")));
  return row;
}

/// Rows of one index stay in their order. Numbers are sorted and each row is moved once, because a
/// row has hundreds of bytes.
Result<std::vector<FrameRow>> sorted_by_index(std::vector<FrameRow> rows,
                                              const RunContext& context) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // index, position
  order.reserve(rows.size());
  for (const FrameRow& row : rows) order.emplace_back(row.info.index, std::uint32_t(order.size()));
  std::sort(order.begin(), order.end());
  std::vector<FrameRow> sorted;
  sorted.reserve(rows.size());
  for (const auto& [index, position] : order) {
    TURNSCAN_TRY(context.check());
    sorted.push_back(std::move(rows[position]));
  }
  return sorted;
}

Result<> check_indices(std::vector<FrameRow>& rows, std::vector<std::string>& notes,
                       const RunContext& context) {
  const auto less = [](const FrameRow& a, const FrameRow& b) {
    return a.info.index < b.info.index;
  };
  if (!std::is_sorted(rows.begin(), rows.end(), less)) {
    TURNSCAN_ASSIGN(rows, sorted_by_index(std::move(rows), context));
    notes.emplace_back("frames.csv is not in the order of the indices; the frames were sorted");
  }
  const auto twice = std::adjacent_find(
      rows.begin(), rows.end(),
      [](const FrameRow& a, const FrameRow& b) { return a.info.index == b.info.index; });
  if (twice == rows.end()) return {};
  return fail(ErrorCode::kFormat, "lines {} and {} have the same index {}", twice->line,
              std::next(twice)->line, twice->info.index);
}

Result<text::CsvColumns> parse_header(text::LineReader& lines) {
  const auto line = lines.next();
  if (!line) return fail(ErrorCode::kFormat, "the header line is missing");
  auto columns = text::CsvColumns::parse(line->text);
  if (!columns) return fail(ErrorCode::kFormat, "line 1: {}", columns.error().message);
  for (const char* name : {"index", "file"}) {
    if (!columns->has(name))
      return fail(ErrorCode::kFormat, "line 1: the header has no column '{}'", name);
  }
  return columns;
}

}  // namespace

std::string frames_csv_header() {
  return "index,time_s,sensor,pass,turn,angle_deg,tx,ty,tz,qx,qy,qz,qw,file,color_file,status\n";
}

std::string frames_csv_line(const FrameInfo& info, const std::string& color_file) {
  std::string line = fmt::format("{},", info.index);
  if (!std::isnan(info.time_s)) line += fmt::format("{}", info.time_s);
  line += fmt::format(",{},{},{},", info.sensor, info.pass, info.turn);
  if (info.angle_rad) line += fixed_text(*info.angle_rad / kRadiansPerDegree, 10);
  if (info.T_table_sensor) {
    const Vec3d t = info.T_table_sensor->translation();
    Eigen::Quaterniond q(info.T_table_sensor->linear());
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();
    for (const double v : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
      line += fmt::format(",{}", fixed_text(v, 12));
  } else {
    line += ",,,,,,,";
  }
  line += fmt::format(",{},{},{}\n", text::csv_field(info.file), text::csv_field(color_file),
                      info.status == FrameStatus::kOk ? "ok" : "dropped");
  return line;
}

Result<FrameTable> parse_frames_csv(std::string_view text, std::size_t sensor_count,
                                    const RunContext& context) {
  FrameTable table;
  // A file system that lost power may leave zeros in place of the last lines.
  const std::size_t whole = text.find_last_not_of('\0') + 1;
  if (whole < text.size())
    table.notes.emplace_back("frames.csv ends with zeros; they were ignored");
  text::LineReader lines(text.substr(0, whole));
  TURNSCAN_ASSIGN(const text::CsvColumns columns, parse_header(lines));
  while (const auto line = lines.next()) {
    TURNSCAN_TRY(context.check());
    if (text::trimmed(line->text).empty()) continue;
    auto row = parse_row(columns, *line, sensor_count);
    if (!row && !line->ended) {
      table.notes.push_back(fmt::format(
          "the last line of frames.csv ({}) is only half written; its frame was left out",
          line->number));
    } else if (!row) {
      return fail(ErrorCode::kFormat, "line {}: {}", line->number, row.error().message);
    } else if (table.rows.size() == kMaxFrames) {
      return fail(ErrorCode::kResourceLimit, "there are more than {} frames", kMaxFrames);
    } else {
      table.rows.push_back(std::move(*row));
    }
  }
  TURNSCAN_TRY(check_indices(table.rows, table.notes, context));
  return table;
}

}  // namespace turnscan::recording_format
