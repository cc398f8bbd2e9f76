// Imports a folder of scans with a table of angles or times.

#include <algorithm>
#include <numbers>
#include <turnscan/core/units.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kMaxSensor = 63;
constexpr std::uint32_t kMaxPass = 1000000;
constexpr std::size_t kMaxTableScans = 1000000;
constexpr const char* kDefaultTable = "angles.csv";

Result<fs::path> find_table(const fs::path& folder, const ImportOptions& options) {
  if (!options.angles.empty()) return fs::path(options.angles);
  TURNSCAN_ASSIGN(const bool there, file::is_there(folder / kDefaultTable));
  if (there) return folder / kDefaultTable;
  return fail_at(folder.string(), ErrorCode::kMissingData,
                 "the scans do not say how far the turntable had turned; give a table with the "
                 "columns file,angle_deg or file,time_s: --angles angles.csv");
}

Result<text::CsvColumns> parse_header(text::LineReader& lines) {
  const auto line = lines.next_content();
  if (!line) return fail(ErrorCode::kFormat, "the table is empty");
  auto columns = text::CsvColumns::parse(line->text);
  if (!columns)
    return fail(ErrorCode::kFormat, "line {}: {}", line->number, columns.error().message);
  if (!columns->has("file") || (!columns->has("angle_deg") && !columns->has("time_s")))
    return fail(ErrorCode::kFormat,
                "line {}: the first line must name the columns file,angle_deg or file,time_s "
                "(pass and sensor may follow)",
                line->number);
  return columns;
}

Result<std::optional<double>> number_field(std::string_view name, std::string_view text) {
  if (text.empty()) return std::optional<double>();
  const auto value = parse_number(text);
  if (!value) return fail(ErrorCode::kFormat, "column {}: {}", name, value.error().message);
  return std::optional<double>(*value);
}

Result<std::uint32_t> index_field(std::string_view name, std::string_view text, std::uint32_t max) {
  if (text.empty()) return 0U;
  auto value = text::parse_index(text, max);
  if (!value) return fail(ErrorCode::kFormat, "column {}: {}", name, value.error().message);
  return value;
}

Result<ForeignFrame> parse_row(const text::CsvColumns& columns, std::string_view text,
                               const fs::path& folder, bool clockwise) {
  TURNSCAN_ASSIGN(const std::vector<std::string> fields, text::csv_fields(text));
  if (fields.size() != columns.size())
    return fail(ErrorCode::kFormat, "there are {} fields, not {}", fields.size(), columns.size());
  ForeignFrame frame;
  FrameInfo& info = frame.info;
  TURNSCAN_ASSIGN(const std::optional<double> degrees,
                  number_field("angle_deg", columns.field(fields, "angle_deg")));
  TURNSCAN_ASSIGN(const std::optional<double> time_s,
                  number_field("time_s", columns.field(fields, "time_s")));
  if (!degrees && !time_s) return fail(ErrorCode::kFormat, "there is neither an angle nor a time");
  if (degrees) info.angle_rad = (clockwise ? -*degrees : *degrees) * std::numbers::pi / 180.0;
  if (time_s) info.time_s = *time_s;
  TURNSCAN_ASSIGN(info.pass, index_field("pass", columns.field(fields, "pass"), kMaxPass));
  TURNSCAN_ASSIGN(info.sensor, index_field("sensor", columns.field(fields, "sensor"), kMaxSensor));
  info.file = std::string(columns.field(fields, "file"));
  TURNSCAN_ASSIGN(frame.data, existing_file(folder, info.file, "the table"));
  return frame;
}

Result<std::vector<ForeignFrame>> parse_table(const fs::path& path, const fs::path& folder,
                                              bool clockwise) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  text::LineReader lines(text);
  auto columns = parse_header(lines);
  if (!columns) return at_path(path, std::move(columns).error());
  std::vector<ForeignFrame> frames;
  while (const auto line = lines.next_content()) {
    auto frame = parse_row(*columns, line->text, folder, clockwise);
    if (!frame)
      return fail_at(path.string(), frame.error().code, "line {}: {}", line->number,
                     frame.error().text());
    if (frames.size() == kMaxTableScans)
      return fail_at(path.string(), ErrorCode::kResourceLimit, "there are more than {} scans",
                     kMaxTableScans);
    frames.push_back(std::move(*frame));
  }
  if (frames.empty()) return fail_at(path.string(), ErrorCode::kFormat, "the table has no scans");
  return frames;
}

/// Sorts by pass, then by time or angle: the order in which the scans were taken, as far as it is
/// known.
void put_in_order(std::vector<ForeignFrame>& frames) {
  const bool timed = std::all_of(frames.begin(), frames.end(),
                                 [](const ForeignFrame& f) { return !std::isnan(f.info.time_s); });
  const auto key = [timed](const ForeignFrame& f) {
    return timed ? f.info.time_s : std::abs(f.info.angle_rad.value_or(0.0));
  };
  std::stable_sort(frames.begin(), frames.end(), [&](const ForeignFrame& a, const ForeignFrame& b) {
    return a.info.pass != b.info.pass ? a.info.pass < b.info.pass : key(a) < key(b);
  });
  for (std::size_t i = 0; i < frames.size(); ++i)
    frames[i].info.index = static_cast<std::uint32_t>(i);
}

/// As stated, else from the first file, else the origin of the scans' frame.
Result<Viewpoint> viewpoint_of(const std::vector<ForeignFrame>& frames,
                               const ImportOptions& options, double metres_per_unit,
                               SequenceHeader& header) {
  TURNSCAN_ASSIGN(const std::optional<Viewpoint> stated, stated_viewpoint(options));
  if (stated) return *stated;
  TURNSCAN_ASSIGN(const CloudFile first, read_cloud(frames.front().data));
  if (first.viewpoint) {
    add_note(header, "the scanner's position was taken from the first file and holds for all");
    Viewpoint viewpoint = *first.viewpoint;
    if (!viewpoint.parallel) viewpoint.value *= metres_per_unit;
    return viewpoint;
  }
  add_note(header,
           "the scanner was taken to stand at the origin of the scans' frame; if it did not, "
           "import again with --sensor-position or --sensor-direction");
  return Viewpoint{};
}

}  // namespace

OpenResult open_cloud_folder(const fs::path& folder, const ImportOptions& options) {
  TURNSCAN_ASSIGN(const fs::path table, find_table(folder, options));
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames, parse_table(table, folder, options.clockwise));
  TURNSCAN_ASSIGN(const double metres_per_unit, point_scale(options, std::nullopt));
  put_in_order(frames);
  SequenceHeader header;
  header.source = fmt::format("scans of {} with {}", display_name(folder), display_name(table));
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  TURNSCAN_ASSIGN(scanner.viewpoint, viewpoint_of(frames, options, metres_per_unit, header));
  std::uint32_t last_sensor = 0;
  for (const ForeignFrame& frame : frames) last_sensor = std::max(last_sensor, frame.info.sensor);
  header.sensors.assign(last_sensor + 1, scanner);
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames, metres_per_unit);
}

}  // namespace turnscan::importers
