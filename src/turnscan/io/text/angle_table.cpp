#include <fmt/ranges.h>
#include <array>
#include <span>
#include <turnscan/core/angles.hpp>
#include <turnscan/io/text/angle_table.hpp>
#include <turnscan/io/text/table_text.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

namespace {

constexpr std::uint32_t kMaxSensor = 63;
constexpr std::uint32_t kMaxPass = 1000000;
constexpr std::size_t kMaxTableRows = 100000;

struct TableUnit {
  std::string_view name;
  double scale;
};
/// The first one is that of columns without a unit.
constexpr std::array<TableUnit, 2> kAngleUnits{{{"deg", kRadiansPerDegree}, {"rad", 1.0}}};
constexpr std::array<TableUnit, 4> kTimeUnits{
    {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};

constexpr std::array<TableUnit, 3> kLengthUnits{{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}}};
constexpr std::array<const char*, 7> kPoseNames{"tx", "ty", "tz", "qx", "qy", "qz", "qw"};

struct TableColumn {
  std::size_t position = 0;
  double scale = 1.0;
};

class AngleColumns {
 public:
  static Result<AngleColumns> parse(std::string_view header_line) {
    AngleColumns out;
    out.delimiter_ = delimiter_of(header_line);
    TURNSCAN_ASSIGN(out.names_, csv_fields(header_line, out.delimiter_));
    TURNSCAN_ASSIGN(out.file_, out.column("file", {}));
    TURNSCAN_ASSIGN(out.angle_, out.column("angle", kAngleUnits));
    TURNSCAN_ASSIGN(out.time_, out.column("time", kTimeUnits));
    TURNSCAN_ASSIGN(out.pass_, out.column("pass", {}));
    TURNSCAN_ASSIGN(out.sensor_, out.column("sensor", {}));
    std::size_t of_pose = 0;
    for (std::size_t i = 0; i < kPoseNames.size(); ++i) {
      const std::span<const TableUnit> units =
          i < 3 ? std::span<const TableUnit>(kLengthUnits) : std::span<const TableUnit>();
      TURNSCAN_ASSIGN(out.pose_[i], out.column(kPoseNames[i], units));
      of_pose += out.pose_[i] ? 1 : 0;
    }
    if (of_pose != 0 && of_pose != kPoseNames.size())
      return fail(ErrorCode::kFormat, "a pose needs the columns {}, but the first line names {}",
                  fmt::join(kPoseNames, ", "), fmt::join(out.names_, ", "));
    if (out.file_ && (out.angle_ || out.time_ || of_pose != 0)) return out;
    return fail(
        ErrorCode::kFormat,
        "the first line must name the columns, but names {}; known are file and angle_deg "
        "or angle_rad, file and time_s or time_ms, or file and tx, ty, tz, qx, qy, qz, qw, and "
        "pass and sensor may follow: rename them",
        fmt::join(out.names_, ", "));
  }

  Result<AngleRow> row(std::string_view line) const {
    TURNSCAN_ASSIGN(const std::vector<std::string> fields, csv_fields(line, delimiter_));
    if (fields.size() != names_.size())
      return fail(ErrorCode::kFormat, "there are {} fields, not {}", fields.size(), names_.size());
    AngleRow out;
    out.file = fields[file_->position];
    TURNSCAN_ASSIGN(out.angle_rad, number(fields, angle_));
    TURNSCAN_ASSIGN(out.time_s, number(fields, time_));
    TURNSCAN_ASSIGN(out.T_world_scan, pose(fields));
    if (!out.angle_rad && !out.time_s && !out.T_world_scan)
      return fail(ErrorCode::kFormat, "there is neither an angle, a time nor a pose");
    TURNSCAN_ASSIGN(out.pass, index(fields, pass_, kMaxPass));
    TURNSCAN_ASSIGN(out.sensor, index(fields, sensor_, kMaxSensor));
    return out;
  }

 private:
  Result<std::optional<TableColumn>> column(std::string_view base,
                                            std::span<const TableUnit> units) const {
    std::optional<TableColumn> found;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const ColumnName name = column_name(names_[i]);
      if (name.base != base) continue;
      if (found) return fail(ErrorCode::kFormat, "two columns are named {}", base);
      found = TableColumn{i, units.empty() ? 1.0 : units.front().scale};
      if (name.unit.empty()) continue;
      const auto unit = std::find_if(units.begin(), units.end(),
                                     [&](const TableUnit& u) { return u.name == name.unit; });
      if (unit == units.end())
        return fail(ErrorCode::kFormat, "the column '{}' has an unknown unit; known are {}",
                    names_[i], units_text(units));
      found->scale = unit->scale;
    }
    return found;
  }

  Result<std::optional<double>> number(const std::vector<std::string>& fields,
                                       const std::optional<TableColumn>& column) const {
    if (!column || fields[column->position].empty()) return std::optional<double>();
    const auto value = parse_decimal(fields[column->position]);
    if (!value)
      return fail(ErrorCode::kFormat, "column {}: {}", names_[column->position],
                  value.error().message);
    return std::optional<double>(*value * column->scale);
  }

  static std::string units_text(std::span<const TableUnit> units) {
    std::vector<std::string_view> names;
    for (const TableUnit& unit : units) names.push_back(unit.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// nullopt if there are no columns for it, or empty ones.
  Result<std::optional<Pose>> pose(const std::vector<std::string>& fields) const {
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
      TURNSCAN_ASSIGN(const std::optional<double> value, number(fields, pose_[i]));
      if (!value) return std::optional<Pose>();
      v[i] = *value;
    }
    TURNSCAN_ASSIGN(const Pose out, pose_from(Vec3d(v[0], v[1], v[2]), v[3], v[4], v[5], v[6]));
    return std::optional<Pose>(out);
  }

  Result<std::uint32_t> index(const std::vector<std::string>& fields,
                              const std::optional<TableColumn>& column, std::uint32_t max) const {
    if (!column || fields[column->position].empty()) return 0U;
    auto value = parse_index(fields[column->position], max);
    if (!value)
      return fail(ErrorCode::kFormat, "column {}: {}", names_[column->position],
                  value.error().message);
    return value;
  }

  char delimiter_ = ',';
  std::vector<std::string> names_;
  std::optional<TableColumn> file_, angle_, time_, pass_, sensor_;
  std::array<std::optional<TableColumn>, 7> pose_;
};

}  // namespace

Result<std::vector<AngleRow>> parse_angle_table(std::string_view bytes) {
  TURNSCAN_ASSIGN(const std::string text, utf8_of(bytes));
  LineReader lines(text);
  const auto first = lines.next_content();
  if (!first) return fail(ErrorCode::kFormat, "the table is empty");
  const auto columns = AngleColumns::parse(first->text);
  if (!columns)
    return fail(ErrorCode::kFormat, "line {}: {}", first->number, columns.error().message);
  std::vector<AngleRow> rows;
  while (const auto line = lines.next_content()) {
    auto row = columns->row(line->text);
    if (!row) return fail(row.error().code, "line {}: {}", line->number, row.error().message);
    if (rows.size() == kMaxTableRows)
      return fail(ErrorCode::kResourceLimit, "there are more than {} scans", kMaxTableRows);
    row->line = line->number;
    rows.push_back(std::move(*row));
  }
  if (rows.empty()) return fail(ErrorCode::kFormat, "the table has no scans");
  return rows;
}

}  // namespace turnscan::text
