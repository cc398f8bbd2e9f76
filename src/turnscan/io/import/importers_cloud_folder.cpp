// Imports a folder of scans with a table of angles or times.

#include <algorithm>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/import/importers_common.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDefaultTable = "angles.csv";

Result<fs::path> find_table(const fs::path& folder, const ImportOptions& options) {
  if (!options.angles.empty()) return fs::path(options.angles);
  TURNSCAN_ASSIGN(const bool there, file::is_there(folder / kDefaultTable));
  if (there) return folder / kDefaultTable;
  return fail_at(folder.string(), ErrorCode::kMissingData,
                 "the scans do not say how far the turntable had turned; give a table with the "
                 "columns file,angle_deg or file,time_s: --angles angles.csv");
}

Result<std::vector<ForeignFrame>> frames_of(const fs::path& path, const fs::path& folder,
                                            const ImportOptions& options,
                                            const RunContext& context) {
  TURNSCAN_ASSIGN(const Eigen::Matrix3d axes, stated_axes(options));
  TURNSCAN_ASSIGN(const std::vector<text::AngleRow> rows, read_angle_table(path));
  std::vector<ForeignFrame> frames;
  for (const text::AngleRow& row : rows) {
    TURNSCAN_TRY(context.check());
    ForeignFrame& frame = frames.emplace_back();
    FrameInfo& info = frame.info;
    if (row.angle_rad) info.angle_rad = options.clockwise ? -*row.angle_rad : *row.angle_rad;
    if (row.time_s) info.time_s = *row.time_s;
    if (row.T_world_scan) {
      if (axes.determinant() < 0.0)
        return fail_at(path.string(), ErrorCode::kUnsupported,
                       "poses of scans with left-handed axes are not read; leave their columns "
                       "out, or --axes");
      TURNSCAN_ASSIGN(info.T_table_sensor, placed_pose(*row.T_world_scan, options));
      *info.T_table_sensor = *info.T_table_sensor * Pose(Eigen::Quaterniond(axes.transpose()));
    }
    info.pass = row.pass;
    info.sensor = row.sensor;
    info.file = row.file;
    auto data = existing_file(folder, row.file, "the table");
    if (!data)
      return fail_at(path.string(), data.error().code, "line {}: {}", row.line,
                     data.error().text());
    frame.data = std::move(*data);
  }
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

/// From the axes of the scans to the sensor frame.
Result<> turn_header(const ImportOptions& options, SequenceHeader& header) {
  TURNSCAN_ASSIGN(const Eigen::Matrix3d axes, stated_axes(options));
  if (!options.axes.empty())
    add_note(header,
             fmt::format("the scans were turned from the axes {} to rdf: x right, y down, z "
                         "forward",
                         options.axes));
  for (SensorInfo& sensor : header.sensors) sensor.viewpoint.value = axes * sensor.viewpoint.value;
  if (!header.turntable) return {};
  header.turntable->axis = axes * header.turntable->axis;
  header.turntable->center_m = axes * header.turntable->center_m;
  return {};
}

}  // namespace

OpenResult open_cloud_folder(const fs::path& folder, const ImportOptions& options,
                             const RunContext& context) {
  TURNSCAN_ASSIGN(const fs::path table, find_table(folder, options));
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames, frames_of(table, folder, options, context));
  TURNSCAN_ASSIGN(const double metres_per_unit, point_scale(options, std::nullopt));
  put_in_order(frames);
  SequenceHeader header;
  header.source = fmt::format("scans of {} with {}", display_name(folder), display_name(table));
  drop_without_pose(frames, header);
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  TURNSCAN_ASSIGN(scanner.viewpoint, viewpoint_of(frames, options, metres_per_unit, header));
  std::uint32_t last_sensor = 0;
  for (const ForeignFrame& frame : frames) last_sensor = std::max(last_sensor, frame.info.sensor);
  header.sensors.assign(last_sensor + 1, scanner);
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  TURNSCAN_TRY(turn_header(options, header));
  TURNSCAN_ASSIGN(const Eigen::Matrix3d axes, stated_axes(options));
  return std::make_unique<ForeignSequence>(std::move(header), frames, metres_per_unit * axes);
}

}  // namespace turnscan::importers
