// Imports the output of `rtabmap-export --images_id --poses_camera DATABASE.db` (introlab/rtabmap,
// tools/Export/main.cpp and corelib/src/CameraModel.cpp), and of rtabmap-databaseViewer's "Extract
// images": NAME_depth/ID.png (16 bit, millimetres, registered to colour), NAME_rgb/ID.jpg,
// NAME_calib/ID.yaml (OpenCV's fields camera_matrix, projection_matrix, image_width, image_height)
// and NAME_camera_poses.txt, lines of `stamp x y z qx qy qz qw id` (poses format 11: the camera in
// a world with z up). With --images the files are named by their stamps instead.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/text/opencv_yaml.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr double kRtabmapDepthUnit = 1e-3;
constexpr double kSameStamp = 1e-4;  // seconds; stamps have six decimals
constexpr std::string_view kDepthFolder = "depth";

struct StampedPose {
  double stamp_s = 0.0;
  std::optional<double> id;
  Pose pose = Pose::Identity();
};

struct RtabmapFrame {
  FrameInfo info;
  double name = 0.0;  ///< the id or the stamp
  fs::path depth, color;
  std::optional<Pose> pose;
};

/// "NAME_" of NAME_depth; empty for depth.
Result<std::string> prefix_in(const fs::path& folder) {
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(folder));
  std::vector<std::string> found;
  for (const std::string& name : names) {
    if (is_rtabmap_depth_folder(name)) found.push_back(name);
  }
  if (found.empty())
    return fail_at(folder.string(), ErrorCode::kNotFound,
                   "there is no folder NAME_depth; export with rtabmap-export --images_id "
                   "--poses_camera");
  if (found.size() > 1)
    return fail_at(folder.string(), ErrorCode::kInvalidOption,
                   "there are several exports ({} and {}); put each into a folder of its own",
                   found[0], found[1]);
  return found[0].substr(0, found[0].size() - kDepthFolder.size());
}

/// The number in a file's name: everything before the extension.
std::optional<double> number_of(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending)) return std::nullopt;
  name.remove_suffix(ending.size());
  double value = 0.0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), value);
  const bool good = error == std::errc() && end == name.data() + name.size();
  return good && value >= 0.0 && value < 1e12 ? std::optional(value) : std::nullopt;
}

Result<std::vector<RtabmapFrame>> list_rtabmap_frames(const fs::path& folder,
                                                      const std::string& prefix,
                                                      const RunContext& context) {
  const fs::path depth = folder / (prefix + "depth"), color = folder / (prefix + "rgb");
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(depth));
  std::vector<RtabmapFrame> frames;
  for (const std::string& name : names) {
    TURNSCAN_TRY(context.check());
    const std::optional<double> number = number_of(name, ".png");
    if (!number) continue;
    RtabmapFrame& frame = frames.emplace_back();
    frame.name = *number;
    frame.info.file = (depth.filename() / name).string();
    frame.depth = depth / name;
    for (const char* ending : {".jpg", ".png"}) {
      const fs::path image = color / (name.substr(0, name.size() - 4) + ending);
      TURNSCAN_ASSIGN(const bool there, file::is_there(image));
      if (there && frame.color.empty()) frame.color = image;
    }
  }
  if (frames.empty())
    return fail_at(depth.string(), ErrorCode::kTooFewPoints, "there are no depth images (ID.png)");
  std::sort(frames.begin(), frames.end(),
            [](const RtabmapFrame& a, const RtabmapFrame& b) { return a.name < b.name; });
  return frames;
}

Result<StampedPose> parse_pose_line(const std::vector<std::string_view>& words) {
  if (words.size() != 8 && words.size() != 9)
    return fail(ErrorCode::kFormat,
                "there are {} words, not 8 or 9; export the poses with --poses_format 11",
                words.size());
  std::array<double, 9> v{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    TURNSCAN_ASSIGN(v[i], parse_number(words[i]));
  }
  StampedPose out;
  out.stamp_s = v[0];
  if (words.size() == 9) out.id = v[8];
  TURNSCAN_ASSIGN(out.pose, pose_from(Vec3d(v[1], v[2], v[3]), v[4], v[5], v[6], v[7]));
  return out;
}

Result<std::vector<StampedPose>> read_camera_poses(const fs::path& folder,
                                                   const std::string& prefix,
                                                   SequenceHeader& header,
                                                   const RunContext& context) {
  const fs::path path = folder / (prefix + "camera_poses.txt");
  std::vector<StampedPose> poses;
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (!there) {
    add_note(header, fmt::format("there is no {}camera_poses.txt (rtabmap-export --poses_camera): "
                                 "frames have no poses",
                                 prefix));
    return poses;
  }
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  text::LineReader lines(text);
  while (const auto line = lines.next_content()) {
    TURNSCAN_TRY(context.check());
    const auto pose = parse_pose_line(text::words_of(line->text));
    if (!pose)
      return fail_at(path.string(), ErrorCode::kFormat, "line {}: {}", line->number,
                     pose.error().message);
    poses.push_back(*pose);
  }
  return poses;
}

/// Matches poses by the id in the file name, or by the stamp. Sets times if stamps are known.
void match_poses(std::vector<StampedPose> poses, std::vector<RtabmapFrame>& frames) {
  const bool by_id = std::all_of(frames.begin(), frames.end(), [](const RtabmapFrame& f) {
    return f.name == std::floor(f.name) && f.name < 1e8;
  });
  const auto key = [&](const StampedPose& p) { return by_id ? p.id.value_or(-1.0) : p.stamp_s; };
  std::sort(poses.begin(), poses.end(),
            [&](const StampedPose& a, const StampedPose& b) { return key(a) < key(b); });
  for (RtabmapFrame& frame : frames) {
    if (!by_id) frame.info.time_s = frame.name;
    const auto pose =
        std::lower_bound(poses.begin(), poses.end(), frame.name - kSameStamp,
                         [&](const StampedPose& p, double wanted) { return key(p) < wanted; });
    if (pose == poses.end() || key(*pose) > frame.name + kSameStamp) continue;
    frame.pose = pose->pose;
    frame.info.time_s = pose->stamp_s;
  }
}

/// For the colour image. Distortion is 0: the export contains rectified images.
Result<CameraIntrinsics> read_calibration(const fs::path& path) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  const bool rectified = text::opencv_has(text, "projection_matrix");
  TURNSCAN_ASSIGN(const auto m, rectified ? text::opencv_matrix(text, "projection_matrix", 12, 12)
                                          : text::opencv_matrix(text, "camera_matrix", 9, 9));
  TURNSCAN_ASSIGN(const double width, text::opencv_number(text, "image_width"));
  TURNSCAN_ASSIGN(const double height, text::opencv_number(text, "image_height"));
  if (!(width >= 1.0 && width <= 65535.0 && height >= 1.0 && height <= 65535.0))
    return fail(ErrorCode::kFormat, "the image has {} x {} pixels", width, height);
  const std::size_t row = rectified ? 4 : 3;
  CameraIntrinsics camera;
  camera.width = int(width);
  camera.height = int(height);
  camera.fx = m[0];
  camera.cx = m[2];
  camera.fy = m[row + 1];
  camera.cy = m[row + 2];
  TURNSCAN_TRY(camera.check());
  return camera;
}

/// From the first frame's calibration, scaled to depth as RTAB-Map does (CameraModel::scaled).
Result<SensorInfo> describe_rtabmap_sensor(const fs::path& calib, const RtabmapFrame& first,
                                           const ImportOptions& options) {
  const fs::path path = calib / (first.depth.stem().string() + ".yaml");
  auto camera = read_calibration(path);
  if (!camera) return at_path(path, std::move(camera).error());
  TURNSCAN_ASSIGN(const DepthImage depth, read_depth_png(first.depth));
  SensorInfo sensor;
  TURNSCAN_ASSIGN(sensor.depth_unit_m, depth_scale(options, kRtabmapDepthUnit));
  const double x = double(depth.width) / camera->width, y = double(depth.height) / camera->height;
  sensor.intrinsics = *camera;
  sensor.intrinsics.width = depth.width;
  sensor.intrinsics.height = depth.height;
  sensor.intrinsics.fx *= x;
  sensor.intrinsics.cx *= x;
  sensor.intrinsics.fy *= y;
  sensor.intrinsics.cy *= y;
  if (depth.width != camera->width || depth.height != camera->height)
    sensor.color_intrinsics = *camera;
  return sensor;
}

Result<> place_rtabmap_frames(ImportOptions options, std::vector<RtabmapFrame>& frames,
                              SequenceHeader& header) {
  if (options.world_up.empty()) options.world_up = "0,0,1";
  std::vector<std::optional<Pose>> poses;
  std::vector<double> times;
  for (const RtabmapFrame& frame : frames) {
    poses.push_back(frame.pose);
    times.push_back(frame.info.time_s);
  }
  TURNSCAN_TRY(settle_device_poses(options, poses, header));
  const bool timed = times_from_first(times);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameInfo& info = frames[i].info;
    info.index = std::uint32_t(i);
    info.T_table_sensor = poses[i];
    info.time_s = timed ? times[i] : std::numeric_limits<double>::quiet_NaN();
  }
  // The map keeps only some of the frames: gaps in the times are not drops.
  drop_without_pose(frames, header);
  return {};
}

}  // namespace

bool is_rtabmap_depth_folder(std::string_view name) {
  return name == kDepthFolder || name.ends_with("_depth");
}

OpenResult open_rtabmap(const fs::path& folder, const ImportOptions& options,
                        const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("RTAB-Map export {}", display_name(folder));
  TURNSCAN_ASSIGN(const std::string prefix, prefix_in(folder));
  TURNSCAN_ASSIGN(std::vector<RtabmapFrame> frames, list_rtabmap_frames(folder, prefix, context));
  TURNSCAN_ASSIGN(SensorInfo sensor,
                  describe_rtabmap_sensor(folder / (prefix + "calib"), frames.front(), options));
  header.sensors.push_back(std::move(sensor));
  TURNSCAN_ASSIGN(std::vector<StampedPose> poses,
                  read_camera_poses(folder, prefix, header, context));
  match_poses(std::move(poses), frames);
  TURNSCAN_TRY(place_rtabmap_frames(options, frames, header));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  std::vector<ForeignFrame> images;
  for (RtabmapFrame& frame : frames)
    images.push_back({std::move(frame.info), std::move(frame.depth), std::move(frame.color), {}});
  return std::make_unique<ForeignSequence>(std::move(header), images);
}

}  // namespace turnscan::importers
