// Imports scans of the Stanford 3D Scanning Repository: a .conf file with one line per scan, `bmesh
// FILE tx ty tz qx qy qz qw`. With R the rotation of the quaternion in the usual convention, a
// point p of the scan is at transpose(R) * p + t in the world; with R itself the bunny's scans are
// misaligned by centimetres. Coordinates are metres.

#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxConfScans = 100000;

Result<fs::path> find_conf(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(path));
  fs::path found;
  for (const std::string& name : names) {
    if (!name.ends_with(".conf")) continue;
    if (!found.empty())
      return fail_at(path.string(), ErrorCode::kInvalidOption,
                     "the folder has several .conf files; name one of them");
    found = path / name;
  }
  if (found.empty())
    return fail_at(path.string(), ErrorCode::kNotFound, "the folder has no .conf file");
  return found;
}

Result<Pose> parse_stanford_pose(const std::vector<std::string_view>& words) {
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto value = parse_number(words[2 + i]);
    if (!value) return fail(ErrorCode::kFormat, "{}", value.error().message);
    v[i] = *value;
  }
  // Negating the vector part transposes the rotation.
  return pose_from(Vec3d(v[0], v[1], v[2]), -v[3], -v[4], -v[5], v[6]);
}

/// nullopt for a line that does not describe a scan.
Result<std::optional<ForeignFrame>> parse_line(std::string_view text, const fs::path& folder,
                                               const ImportOptions& options) {
  const auto words = text::words_of(text);
  if (words[0] == "camera") return std::optional<ForeignFrame>();  // for a viewer
  if (words[0] != "bmesh" && words[0] != "mesh")
    return fail(ErrorCode::kFormat, "'{}' is none of bmesh, mesh, camera", words[0]);
  if (words.size() != 9)
    return fail(ErrorCode::kFormat, "there are {} words, not 9 (bmesh FILE tx ty tz qx qy qz qw)",
                words.size());
  ForeignFrame frame;
  TURNSCAN_ASSIGN(const Pose pose, parse_stanford_pose(words));
  TURNSCAN_ASSIGN(frame.info.T_table_sensor, placed_pose(pose, options));
  frame.info.file = std::string(words[1]);
  TURNSCAN_ASSIGN(frame.data, existing_file(folder, words[1], "the .conf file"));
  return std::optional<ForeignFrame>(std::move(frame));
}

Result<std::vector<ForeignFrame>> parse_conf(const fs::path& path, const ImportOptions& options,
                                             const RunContext& context) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  std::vector<ForeignFrame> frames;
  text::LineReader lines(text);
  while (const auto line = lines.next_content()) {
    TURNSCAN_TRY(context.check());
    auto frame = parse_line(line->text, path.parent_path(), options);
    if (!frame)
      return fail_at(path.string(), frame.error().code, "line {}: {}", line->number,
                     frame.error().text());
    if (!*frame) continue;
    if (frames.size() == kMaxConfScans)
      return fail_at(path.string(), ErrorCode::kResourceLimit, "there are more than {} scans",
                     kMaxConfScans);
    (*frame)->info.index = static_cast<std::uint32_t>(frames.size());
    frames.push_back(std::move(**frame));
  }
  if (frames.empty())
    return fail_at(path.string(), ErrorCode::kFormat, "there is no line that names a scan");
  return frames;
}

}  // namespace

OpenResult open_stanford_conf(const fs::path& path, const ImportOptions& options,
                              const RunContext& context) {
  TURNSCAN_ASSIGN(const fs::path conf, find_conf(path));
  TURNSCAN_ASSIGN(const std::vector<ForeignFrame> frames, parse_conf(conf, options, context));
  TURNSCAN_ASSIGN(const double metres_per_unit, point_scale(options, 1.0));
  TURNSCAN_ASSIGN(const std::optional<Viewpoint> viewpoint, stated_viewpoint(options));
  SequenceHeader header;
  header.source = fmt::format("range scans of {}", display_name(conf));
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  scanner.viewpoint = viewpoint.value_or(Viewpoint{Vec3d::UnitZ(), true});
  header.sensors.push_back(scanner);
  if (options.point_unit == LengthUnit::kAuto)
    add_note(header, "coordinates are metres, as the Stanford repository defines");
  if (!viewpoint)
    add_note(header,
             "each scan is seen along parallel rays from +z of its own frame, as a "
             "Cyberware scanner sees");
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames,
                                           metres_per_unit * Eigen::Matrix3d::Identity());
}

}  // namespace turnscan::importers
