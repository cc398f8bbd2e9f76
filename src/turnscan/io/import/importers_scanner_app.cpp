// Imports exports of Laan Labs' 3D Scanner App for iPhones and iPads (3dscannerapp.com), "Share >
// All data": for each frame frame_00012.json (intrinsics: 3x3, row by row, of the colour image;
// cameraPoseARFrame: 4x4, row by row, ARKit's camera to its world, y up; time), depth_00012.png (16
// bit, millimetres, registered to colour), conf_00012.png (0 to 2) and for some frames
// frame_00012.jpg.
// The names are taken from such exports and from programs that read them; the vendor publishes no
// description.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kMaxFrameNumber = 4000000;
/// Size of ARKit's images, if none states it.
constexpr int kColorWidth = 1920, kColorHeight = 1440;

struct AppFrame {
  FrameInfo info;
  fs::path depth, color, confidence;
  CameraIntrinsics camera;  ///< of the colour image, relative to its corner; without its size
  std::optional<Pose> pose;
};

class AppSequence : public FrameSequence {
 public:
  AppSequence(std::unique_ptr<ForeignSequence> images, std::vector<fs::path> confidence,
              std::uint8_t least)
      : images_(std::move(images)), confidence_(std::move(confidence)), least_(least) {}
  const SequenceHeader& header() const override { return images_->header(); }
  const std::vector<FrameInfo>& frames() const override { return images_->frames(); }

  Result<Frame> read(std::size_t position) const override {
    TURNSCAN_ASSIGN(Frame frame, images_->read(position));
    const fs::path& path = confidence_[position];
    if (path.empty() || least_ == 0) return frame;
    TURNSCAN_ASSIGN(const ColorImage levels, read_color(path));
    if (levels.width != frame.depth.width || levels.height != frame.depth.height)
      return fail_at(path.string(), ErrorCode::kFormat,
                     "the confidence has {} x {} pixels, but depth {} x {}", levels.width,
                     levels.height, frame.depth.width, frame.depth.height);
    std::vector<std::uint8_t> values;
    values.reserve(levels.pixels.size());
    for (const Rgb& pixel : levels.pixels) values.push_back(pixel.r);
    mask_unsure(values, least_, frame.depth);
    return frame;
  }

 private:
  std::unique_ptr<ForeignSequence> images_;
  std::vector<fs::path> confidence_;
  std::uint8_t least_;
};

Result<> parse_app_frame(const fs::path& path, AppFrame& frame, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text, context));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(json, text));
  TURNSCAN_ASSIGN(const std::vector<double> k, root.numbers("intrinsics"));
  if (k.size() != 9) return fail(ErrorCode::kFormat, "intrinsics has {} numbers, not 9", k.size());
  frame.camera.fx = k[0];
  frame.camera.fy = k[4];
  frame.camera.cx = k[2];
  frame.camera.cy = k[5];
  TURNSCAN_ASSIGN(frame.info.time_s,
                  root.number_or("time", std::numeric_limits<double>::quiet_NaN()));
  // An invalid pose: tracking was lost.
  if (root.has("cameraPoseARFrame")) {
    if (const auto pose = root.pose("cameraPoseARFrame")) frame.pose = from_gl_camera(*pose);
  }
  return {};
}

/// Frames with depth, sorted by their numbers, which are in info.index.
Result<std::vector<AppFrame>> list_app_frames(const fs::path& folder, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<std::string> list, names_in(folder));
  const std::set<std::string, std::less<>> names(list.begin(), list.end());
  std::vector<AppFrame> frames;
  for (const std::string& name : list) {
    TURNSCAN_TRY(context.check());
    if (!is_scanner_app_frame(name)) continue;
    const std::string number = name.substr(6, name.size() - 11);
    const std::string depth = fmt::format("depth_{}.png", number),
                      confidence = fmt::format("conf_{}.png", number),
                      color = fmt::format("frame_{}.jpg", number);
    if (!names.contains(depth)) continue;
    AppFrame& frame = frames.emplace_back();
    TURNSCAN_ASSIGN(frame.info.index, text::parse_index(number, kMaxFrameNumber));
    frame.info.file = depth;
    frame.depth = folder / depth;
    if (names.contains(confidence)) frame.confidence = folder / confidence;
    if (names.contains(color)) frame.color = folder / color;
    if (auto good = parse_app_frame(folder / name, frame, context); !good)
      return at_path(folder / name, std::move(good).error());
  }
  if (frames.empty())
    return fail_at(folder.string(), ErrorCode::kNotFound,
                   "there is no frame_N.json with a depth_N.png beside it; export \"All data\", "
                   "with depth");
  std::sort(frames.begin(), frames.end(),
            [](const AppFrame& a, const AppFrame& b) { return a.info.index < b.info.index; });
  return frames;
}

double middle_of(const std::vector<AppFrame>& frames, double CameraIntrinsics::*field) {
  std::vector<double> values;
  for (const AppFrame& frame : frames) values.push_back(frame.camera.*field);
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// The median of the cameras of all frames, because the focus varies.
Result<SensorInfo> describe_app_sensor(const std::vector<AppFrame>& frames,
                                       SequenceHeader& header) {
  CameraIntrinsics camera;
  for (const auto field :
       {&CameraIntrinsics::fx, &CameraIntrinsics::fy, &CameraIntrinsics::cx, &CameraIntrinsics::cy})
    camera.*field = middle_of(frames, field);
  camera.width = kColorWidth;
  camera.height = kColorHeight;
  const auto colored = std::find_if(frames.begin(), frames.end(),
                                    [](const AppFrame& f) { return !f.color.empty(); });
  if (colored != frames.end()) {
    TURNSCAN_ASSIGN(const ColorImage color, read_color(colored->color));
    camera.width = color.width;
    camera.height = color.height;
  } else {
    add_note(header, fmt::format("there is no colour image: the intrinsics were taken for one of "
                                 "{} x {} pixels",
                                 kColorWidth, kColorHeight));
  }
  TURNSCAN_ASSIGN(const DepthImage depth, read_depth_png(frames.front().depth));
  SensorInfo sensor;
  sensor.model = "iphone-lidar";
  add_note(header, kLidarNote);
  sensor.depth_unit_m = 1e-3;
  sensor.intrinsics = from_corner_coordinates(camera, depth.width, depth.height);
  if (colored != frames.end())
    sensor.color_intrinsics = from_corner_coordinates(camera, camera.width, camera.height);
  TURNSCAN_TRY(sensor.intrinsics.check());
  return sensor;
}

Result<> place_app_frames(const ImportOptions& options, std::vector<AppFrame>& frames,
                          SequenceHeader& header) {
  std::vector<std::optional<Pose>> poses;
  std::vector<double> times;
  for (const AppFrame& frame : frames) {
    poses.push_back(frame.pose);
    times.push_back(frame.info.time_s);
  }
  TURNSCAN_TRY(settle_device_poses(options, poses, header));
  const bool timed = times_from_first(times);
  if (!timed) add_note(header, "there are no times of the frames that increase");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].info.T_table_sensor = poses[i];
    frames[i].info.time_s = timed ? times[i] : std::numeric_limits<double>::quiet_NaN();
  }
  if (timed) frames = with_dropped(std::move(frames), header);
  drop_without_pose(frames, header);
  return {};
}

}  // namespace

bool is_scanner_app_frame(std::string_view name) {
  constexpr std::string_view kBegin = "frame_", kEnd = ".json";
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd)) return false;
  name = name.substr(kBegin.size());
  name.remove_suffix(std::min(name.size(), kEnd.size()));
  return name.size() >= 5 &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

OpenResult open_scanner_app(const fs::path& folder, const ImportOptions& options,
                            const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("3D Scanner App export {}", display_name(folder));
  TURNSCAN_ASSIGN(std::vector<AppFrame> frames, list_app_frames(folder, context));
  TURNSCAN_ASSIGN(SensorInfo sensor, describe_app_sensor(frames, header));
  header.sensors.push_back(std::move(sensor));
  TURNSCAN_TRY(place_app_frames(options, frames, header));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  std::vector<ForeignFrame> images;
  std::vector<fs::path> confidence;
  for (AppFrame& frame : frames) {
    images.push_back({std::move(frame.info), std::move(frame.depth), std::move(frame.color), {}});
    confidence.push_back(std::move(frame.confidence));
  }
  return std::make_unique<AppSequence>(std::make_unique<ForeignSequence>(std::move(header), images),
                                       std::move(confidence), least_confidence(options));
}

}  // namespace turnscan::importers
