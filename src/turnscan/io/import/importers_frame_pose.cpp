// Imports the layout of 7-Scenes (Microsoft Research) and of andyzeng/tsdf-fusion:
// frame-N.depth.png with frame-N.pose.txt (4x4, camera to world), frame-N.color.png or .jpg,
// camera-intrinsics.txt (3x3). A pose that is not finite marks a frame with lost tracking.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "frame-";
constexpr std::string_view kDepthSuffix = ".depth.png";
constexpr std::uint32_t kMaxFileNumber = 4000000000;

/// Whether the text has 16 numbers, at least one of which is not finite.
bool lost_tracking(std::string_view text) {
  const auto words = text::words_of(text);
  bool lost = false;
  for (const std::string_view word : words) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return false;
    lost = lost || !std::isfinite(value);
  }
  return lost && words.size() == 16;
}

/// nullopt if there is no pose, or one that is not finite.
Result<std::optional<Pose>> read_pose(const fs::path& path) {
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (!there) return std::optional<Pose>();
  TURNSCAN_ASSIGN(const std::string text, read_file(path, 1 << 16));
  if (lost_tracking(text)) return std::optional<Pose>();
  const auto numbers = text::parse_numbers(text, 16);
  if (!numbers)
    return fail_at(path.string(), ErrorCode::kFormat, "this is not a 4x4 pose: {}",
                   numbers.error().message);
  auto pose = text::pose_from_rows(*numbers);
  if (!pose) return at_path(path, std::move(pose).error());
  return std::optional<Pose>(*pose);
}

Result<std::vector<ForeignFrame>> list_frames(const fs::path& folder, const ImportOptions& options,
                                              const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<std::string> list, names_in(folder));
  const std::set<std::string, std::less<>> names(list.begin(), list.end());
  std::vector<ForeignFrame> frames;
  for (const std::string& name : list) {
    TURNSCAN_TRY(context.check());
    if (!name.starts_with(kPrefix) || !name.ends_with(kDepthSuffix)) continue;
    const std::string base = name.substr(0, name.size() - kDepthSuffix.size());
    const auto number =
        text::parse_index(std::string_view(base).substr(kPrefix.size()), kMaxFileNumber);
    if (!number) return at_path(folder / name, number.error());
    ForeignFrame frame;
    frame.info.index = *number;
    frame.info.file = name;
    frame.data = folder / name;
    for (const char* color : {".color.png", ".color.jpg", ".color.jpeg"}) {
      if (frame.color.empty() && names.contains(base + color))
        frame.color = folder / (base + color);
    }
    TURNSCAN_ASSIGN(const std::optional<Pose> pose, read_pose(folder / (base + ".pose.txt")));
    if (pose) {
      TURNSCAN_ASSIGN(frame.info.T_table_sensor, placed_pose(*pose, options));
    }
    frames.push_back(std::move(frame));
  }
  std::sort(frames.begin(), frames.end(), [](const ForeignFrame& a, const ForeignFrame& b) {
    return a.info.index < b.info.index;
  });
  return frames;
}

Result<> check_indices(const std::vector<ForeignFrame>& frames) {
  const auto twice = std::adjacent_find(
      frames.begin(), frames.end(),
      [](const ForeignFrame& a, const ForeignFrame& b) { return a.info.index == b.info.index; });
  if (twice == frames.end()) return {};
  return fail(ErrorCode::kFormat, "{} and {} have the same number", twice->info.file,
              std::next(twice)->info.file);
}

/// Frames without a pose cannot be used together with frames that have one.
void drop_unplaced(std::vector<ForeignFrame>& frames, SequenceHeader& header) {
  const auto unplaced = static_cast<std::size_t>(std::count_if(
      frames.begin(), frames.end(), [](const ForeignFrame& f) { return !f.info.T_table_sensor; }));
  if (unplaced == 0 || unplaced == frames.size()) return;
  for (ForeignFrame& frame : frames) {
    if (!frame.info.T_table_sensor) frame.info.status = FrameStatus::kDropped;
  }
  add_note(header, fmt::format("{} of {} frames have no pose or one that is not finite; they are "
                               "marked dropped",
                               unplaced, frames.size()));
}

Result<CameraIntrinsics> intrinsics_of(const fs::path& folder, const ImportOptions& options) {
  if (!options.intrinsics.empty()) return stated_intrinsics(options);
  TURNSCAN_ASSIGN(const auto kinect, iai_kinect2_intrinsics(options));
  if (kinect) return *kinect;
  const fs::path path = folder / "camera-intrinsics.txt";
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (there) return intrinsics_from_file(path);
  return fail_at(folder.string(), ErrorCode::kMissingData,
                 "there is no camera-intrinsics.txt; state the intrinsics: --intrinsics "
                 "fx,fy,cx,cy");
}

}  // namespace

OpenResult open_frame_pose(const fs::path& folder, const ImportOptions& options,
                           const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("frame-N.depth.png folder {}", display_name(folder));
  SensorInfo sensor;
  TURNSCAN_ASSIGN(sensor.intrinsics, intrinsics_of(folder, options));
  TURNSCAN_ASSIGN(sensor.depth_unit_m, depth_scale(options, std::nullopt));
  header.sensors.push_back(sensor);
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames, list_frames(folder, options, context));
  if (auto good = check_indices(frames); !good) return at_path(folder, std::move(good).error());
  drop_unplaced(frames, header);
  TURNSCAN_TRY(apply_iai_kinect2(options, frames, header));
  TURNSCAN_TRY(look_at_first_images(header, frames));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames);
}

}  // namespace turnscan::importers
