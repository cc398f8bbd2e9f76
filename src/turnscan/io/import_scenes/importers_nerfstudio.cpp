// Imports nerfstudio's transforms.json with depth (docs.nerf.studio, "Data conventions"), which
// ns-process-data also makes of recordings by Polycam and Record3D: poses are camera to world with
// the axes of OpenGL (x right, y up, z backward), the world has +z up, the centre of the top left
// pixel is at 0.5, 0.5, and depth is in millimetres.

#include <map>
#include <nlohmann/json.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/import_scenes/scene_sensors.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;
using text::JsonObject;

namespace {

constexpr double kNerfstudioStep = 1e-3;  // metres

/// A field of the frame, or of all frames.
class NerfstudioFields {
 public:
  NerfstudioFields(const JsonObject& frame, const JsonObject& root) : frame_(frame), root_(root) {}
  const JsonObject& with(const char* key) const { return frame_.has(key) ? frame_ : root_; }

 private:
  const JsonObject& frame_;
  const JsonObject& root_;
};

/// With image coordinates from the corner of the colour image.
Result<CameraIntrinsics> nerfstudio_camera(const NerfstudioFields& fields) {
  TURNSCAN_ASSIGN(const std::string model,
                  fields.with("camera_model").text_or("camera_model", "OPENCV"));
  TURNSCAN_ASSIGN(const double k4, fields.with("k4").number_or("k4", 0.0));
  if ((model != "OPENCV" && model != "PINHOLE" && model != "SIMPLE_PINHOLE") || k4 != 0.0)
    return fail(ErrorCode::kUnsupported,
                "cameras of the model {}{} are not read, only OPENCV with k1, k2, k3, p1 and p2",
                model, k4 != 0.0 ? " with k4" : "");
  CameraIntrinsics out;
  TURNSCAN_ASSIGN(out.width, fields.with("w").integer("w", 1, 65535));
  TURNSCAN_ASSIGN(out.height, fields.with("h").integer("h", 1, 65535));
  TURNSCAN_ASSIGN(out.fx, fields.with("fl_x").number("fl_x"));
  TURNSCAN_ASSIGN(out.fy, fields.with("fl_y").number_or("fl_y", out.fx));
  TURNSCAN_ASSIGN(out.cx, fields.with("cx").number("cx"));
  TURNSCAN_ASSIGN(out.cy, fields.with("cy").number("cy"));
  constexpr std::array<const char*, 5> kNames{"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    TURNSCAN_ASSIGN(out.distortion[i], fields.with(kNames[i]).number_or(kNames[i], 0.0));
  }
  return out;
}

struct NerfstudioScene {
  std::vector<ForeignFrame> frames;
  std::vector<std::optional<Pose>> poses;  ///< in their world
};

/// Reads the frames that have depth. The first image of each size of colour tells that of depth.
class NerfstudioReader {
 public:
  NerfstudioReader(const JsonObject& root, const ImportOptions& options, const fs::path& folder)
      : root_(root), options_(options), folder_(folder) {}

  Result<NerfstudioScene> read(SequenceHeader& header, const RunContext& context) {
    TURNSCAN_ASSIGN(const std::vector<JsonObject> frames, root_.objects("frames"));
    TURNSCAN_ASSIGN(unit_m_, root_.number_or("depth_unit_scale_factor", kNerfstudioStep));
    TURNSCAN_ASSIGN(unit_m_, depth_scale(options_, unit_m_));
    TURNSCAN_ASSIGN(const double scale, root_.number_or("applied_scale", 1.0));
    if (!(unit_m_ > 0.0 && unit_m_ <= 1.0) || !(scale > 0.0))
      return fail(ErrorCode::kFormat,
                  "depth_unit_scale_factor or applied_scale is out of range: {}, {}", unit_m_,
                  scale);
    NerfstudioScene out;
    for (const JsonObject& frame : frames) {
      TURNSCAN_TRY(context.check());
      if (!frame.has("depth_file_path")) continue;
      TURNSCAN_ASSIGN(ForeignFrame read, read_frame(frame));
      read.info.index = std::uint32_t(out.frames.size());
      if (options_.fps) read.info.time_s = double(read.info.index) / *options_.fps;
      out.frames.push_back(std::move(read));
      TURNSCAN_ASSIGN(Pose T_world_gl, frame.pose("transform_matrix"));
      T_world_gl.translation() /= scale;
      out.poses.emplace_back(from_gl_camera(T_world_gl));
    }
    if (out.frames.empty())
      return fail(ErrorCode::kMissingData,
                  "its {} frames have no depth (depth_file_path), which turnscan works from; let "
                  "ns-process-data keep the depth",
                  frames.size());
    if (out.frames.size() < frames.size())
      add_note(header, fmt::format("{} of {} frames have no depth and were left out",
                                   frames.size() - out.frames.size(), frames.size()));
    header.sensors = sensors_.take();
    return out;
  }

 private:
  Result<ForeignFrame> read_frame(const JsonObject& frame) {
    ForeignFrame out;
    TURNSCAN_ASSIGN(out.info.file, frame.text_or("depth_file_path", ""));
    TURNSCAN_ASSIGN(out.data, existing_file(folder_, out.info.file, "the JSON file"));
    TURNSCAN_ASSIGN(const std::string color, frame.text_or("file_path", ""));
    if (!color.empty() && color != out.info.file) {
      TURNSCAN_ASSIGN(out.color, existing_file(folder_, color, "the JSON file"));
    }
    TURNSCAN_ASSIGN(const CameraIntrinsics camera, nerfstudio_camera({frame, root_}));
    TURNSCAN_TRY(camera.check());
    const auto [size, is_new] = depth_size_.try_emplace({camera.width, camera.height});
    if (is_new) {
      TURNSCAN_ASSIGN(const DepthImage depth, read_depth_png(out.data));
      size->second = {depth.width, depth.height};
    }
    const auto [width, height] = size->second;
    SensorInfo sensor;
    sensor.depth_unit_m = unit_m_;
    sensor.intrinsics = from_corner_coordinates(camera, width, height);
    if (std::pair(width, height) != size->first && !out.color.empty())
      sensor.color_intrinsics = from_corner_coordinates(camera, camera.width, camera.height);
    TURNSCAN_ASSIGN(out.info.sensor, sensors_.number_of(sensor));
    return out;
  }

  const JsonObject& root_;
  const ImportOptions& options_;
  const fs::path& folder_;
  double unit_m_ = kNerfstudioStep;
  SceneSensors sensors_;
  std::map<std::pair<int, int>, std::pair<int, int>> depth_size_;  ///< by that of colour
};

}  // namespace

OpenResult open_nerfstudio(const fs::path& path, const ImportOptions& options,
                           const RunContext& context) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? path / "transforms.json" : path;
  const fs::path folder = file.parent_path();
  TURNSCAN_ASSIGN(const std::string text, read_file(file, kMaxTextBytes));
  SequenceHeader header;
  header.source = fmt::format("nerfstudio scene {}", display_name(path));
  ImportOptions placing = options;
  if (placing.world_up.empty()) placing.world_up = "0,0,1";
  auto scene = [&]() -> Result<NerfstudioScene> {
    TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text, context));
    TURNSCAN_ASSIGN(const JsonObject root, JsonObject::from(json, text));
    return NerfstudioReader(root, options, folder).read(header, context);
  }();
  if (!scene) return at_path(file, std::move(scene).error());
  TURNSCAN_TRY(settle_device_poses(placing, scene->poses, header));
  if (auto placed = place_frames(scene->poses, scene->frames); !placed)
    return at_path(file, std::move(placed).error());
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), scene->frames);
}

}  // namespace turnscan::importers
