// Imports folders written by Open3D's recorders: color/NNNNN.jpg and depth/NNNNN.png, depth aligned
// to colour, with intrinsic.json (azure_kinect_mkv_reader, RGBDVideoReader) or
// camera_intrinsic.json (realsense_recorder). Fields as in Open3D 0.19:
// camera::PinholeCameraIntrinsic, whose matrix is stored column by column, and
// t::io::RGBDVideoMetadata (depth_scale: steps per metre, fps). Open3D's programs default to 1000
// steps per metre.

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kMaxImageNumber = 4000000000;
constexpr double kStepsPerMetre = 1000.0;

/// Content of the folder's JSON files.
struct Open3dFolder {
  CameraIntrinsics camera;
  std::optional<double> steps_per_metre, fps;
  std::string device;
};

Result<std::optional<double>> positive(const text::JsonObject& object, const char* key) {
  TURNSCAN_ASSIGN(const std::optional<double> value, object.optional_number(key));
  if (value && !(*value >= 1e-3 && *value <= 1e7))
    return fail(ErrorCode::kFormat, "{} = {} is outside 0.001 to 10000000", object.place_of(key),
                *value);
  return value;
}

Result<Open3dFolder> parse_intrinsic(std::string_view text, const RunContext& context) {
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text, context));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(json, text));
  Open3dFolder out;
  CameraIntrinsics& c = out.camera;
  TURNSCAN_ASSIGN(c.width, root.integer("width", 1, 65535));
  TURNSCAN_ASSIGN(c.height, root.integer("height", 1, 65535));
  TURNSCAN_ASSIGN(const std::vector<double> m, root.numbers("intrinsic_matrix"));
  if (m.size() != 9 || m[1] != 0.0 || m[2] != 0.0 || m[3] != 0.0 || m[5] != 0.0 || m[8] != 1.0)
    return fail(ErrorCode::kFormat,
                "intrinsic_matrix is not a 3x3 camera matrix, column by column: fx, 0, 0, 0, fy, "
                "0, cx, cy, 1");
  c.fx = m[0], c.fy = m[4], c.cx = m[6], c.cy = m[7];
  TURNSCAN_TRY(c.check());
  TURNSCAN_ASSIGN(out.steps_per_metre, positive(root, "depth_scale"));
  TURNSCAN_ASSIGN(out.fps, positive(root, "fps"));
  TURNSCAN_ASSIGN(out.device, root.text_or("device_name", ""));
  if (out.device.empty() && root.has("depth_mode")) out.device = "azure-kinect";
  return out;
}

Result<std::optional<double>> parse_config_scale(std::string_view text, const RunContext& context) {
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text, context));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(json, text));
  return positive(root, "depth_scale");
}

Result<Open3dFolder> read_descriptions(const fs::path& folder, const RunContext& context) {
  fs::path path = folder / "intrinsic.json";
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (!there) path = folder / "camera_intrinsic.json";
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  auto out = parse_intrinsic(text, context);
  if (!out) return at_path(path, std::move(out).error());
  const fs::path config = folder / "config.json";
  TURNSCAN_ASSIGN(const bool configured, file::is_there(config));
  if (!configured || out->steps_per_metre) return out;
  TURNSCAN_ASSIGN(const std::string config_text, read_file(config, kMaxTextBytes));
  auto scale = parse_config_scale(config_text, context);
  if (!scale) return at_path(config, std::move(scale).error());
  out->steps_per_metre = *scale;
  return out;
}

/// "Intel RealSense D435I" is a D435 with a motion sensor.
std::string model_of_device(const std::string& device) {
  std::string lower;
  for (const char c : device)
    lower += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c < ' ' ? ' ' : c;
  for (const char* series : {"d405", "d435", "d455"})
    if (lower.find(series) != std::string::npos) return fmt::format("realsense-{}", series);
  if (lower.find("azure") != std::string::npos) return "azure-kinect";
  return lower.substr(0, 64);
}

/// Files NNNNN.png or .jpg of a subfolder by number; others are ignored.
Result<std::map<std::uint32_t, fs::path>> numbered_images(const fs::path& folder,
                                                          const RunContext& context) {
  std::map<std::uint32_t, fs::path> out;
  TURNSCAN_ASSIGN(const bool there, file::is_there(folder));
  if (!there) return out;
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(folder));
  for (const std::string& name : names) {
    TURNSCAN_TRY(context.check());
    const fs::path path = folder / name;
    const std::string ending = path.extension().string();
    if (ending != ".png" && ending != ".jpg" && ending != ".jpeg") continue;
    const auto number = text::parse_index(path.stem().string(), kMaxImageNumber);
    if (!number) continue;
    if (!out.emplace(*number, path).second)
      return fail_at(path.string(), ErrorCode::kFormat, "{} has the same number",
                     out[*number].filename().string());
  }
  return out;
}

Result<std::vector<ForeignFrame>> list_images(const fs::path& folder, std::optional<double> fps,
                                              const RunContext& context) {
  TURNSCAN_ASSIGN(const auto depths, numbered_images(folder / "depth", context));
  TURNSCAN_ASSIGN(const auto colors, numbered_images(folder / "color", context));
  std::vector<ForeignFrame> frames;
  for (const auto& [number, path] : depths) {
    ForeignFrame frame;
    frame.info.index = number;
    if (fps) frame.info.time_s = (double(number) - double(depths.begin()->first)) / *fps;
    frame.info.file = fmt::format("depth/{}", path.filename().string());
    frame.data = path;
    if (const auto color = colors.find(number); color != colors.end()) frame.color = color->second;
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace

OpenResult open_open3d_rgbd(const fs::path& folder, const ImportOptions& options,
                            const RunContext& context) {
  TURNSCAN_ASSIGN(const Open3dFolder described, read_descriptions(folder, context));
  SequenceHeader header;
  header.source = fmt::format("Open3D folder {}", display_name(folder));
  SensorInfo sensor;
  sensor.model = model_of_device(described.device);
  sensor.intrinsics = described.camera;
  if (!options.intrinsics.empty()) {
    TURNSCAN_ASSIGN(sensor.intrinsics, stated_intrinsics(options));
  }
  TURNSCAN_ASSIGN(sensor.depth_unit_m,
                  depth_scale(options, 1.0 / described.steps_per_metre.value_or(kStepsPerMetre)));
  if (!options.depth_unit_m && !described.steps_per_metre)
    add_note(header,
             "depth images have 1000 steps a metre, as Open3D assumes; --depth-unit states "
             "another scale");
  const std::optional<double> fps = options.fps ? options.fps : described.fps;
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames, list_images(folder, fps, context));
  if (frames.empty())
    return fail_at((folder / "depth").string(), ErrorCode::kTooFewPoints,
                   "there are no images NNNNN.png");
  if (fps)
    add_note(header,
             fmt::format("times are counted from the numbers of the images, {} a second", *fps));
  else
    add_note(header,
             "the images do not say their times: state the rate with --fps where the "
             "turntable's speed is known");
  header.sensors.push_back(sensor);
  TURNSCAN_TRY(look_at_first_images(header, frames));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames);
}

}  // namespace turnscan::importers
