// Imports a scene of the BOP benchmark (github.com/thodan/bop_toolkit,
// docs/bop_datasets_format.md): depth/NNNNNN.png with scene_camera.json (cam_K, depth_scale in
// millimetres, and the pose of the world where there is one) and scene_gt.json (poses of the
// objects). Frames are placed by the world, or by the object where all images show one.

#include <map>
#include <nlohmann/json.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import_scenes/scene_sensors.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;
using text::JsonObject;

namespace {

constexpr double kBopUnit = 1e-3;  // metres
constexpr std::uint32_t kMaxBopImage = 1000000;

/// The members of a JSON object by their names, which are numbers of images.
template <class Take>
Result<> for_each_image(const fs::path& path, const RunContext& context, const Take& take) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  const auto read = text::for_each_json_member(
      text, context, [&](const std::string& name, const text::Json& value) -> Result<> {
        TURNSCAN_TRY(context.check());
        TURNSCAN_ASSIGN(const std::uint32_t number, text::parse_index(name, kMaxBopImage));
        return take(number, value, text::JsonPlace{name, text});
      });
  if (!read) return at_path(path, read.error());
  return {};
}

/// T_camera_NAME of cam_R_NAME2c (row by row) and cam_t_NAME2c (millimetres).
Result<Pose> bop_pose(const JsonObject& object, const std::string& name) {
  TURNSCAN_ASSIGN(const std::vector<double> r, object.numbers(("cam_R_" + name).c_str()));
  TURNSCAN_ASSIGN(const Vec3d t, object.vector(("cam_t_" + name).c_str()));
  if (r.size() != 9)
    return fail(ErrorCode::kFormat, "cam_R_{} has {} numbers, not 9", name, r.size());
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
  matrix.topRightCorner<3, 1>() = kBopUnit * t;
  return pose_from(matrix);
}

struct BopImage {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0, depth_unit_m = 0.0;
  std::optional<Pose> T_camera_place;  ///< of what places it: the world or the object
};
using BopImages = std::map<std::uint32_t, BopImage>;

Result<BopImages> read_bop_cameras(const fs::path& path, const ImportOptions& options,
                                   const RunContext& context) {
  BopImages out;
  TURNSCAN_TRY(for_each_image(
      path, context,
      [&](std::uint32_t number, const text::Json& value, text::JsonPlace place) -> Result<> {
        TURNSCAN_ASSIGN(const JsonObject object, JsonObject::from(value, std::move(place)));
        TURNSCAN_ASSIGN(const std::vector<double> k, object.numbers("cam_K"));
        if (k.size() != 9) return fail(ErrorCode::kFormat, "cam_K has {} numbers, not 9", k.size());
        BopImage image;
        image.fx = k[0], image.cx = k[2], image.fy = k[4], image.cy = k[5];
        TURNSCAN_ASSIGN(const double scale, object.number_or("depth_scale", 1.0));
        TURNSCAN_ASSIGN(image.depth_unit_m, depth_scale(options, kBopUnit * scale));
        if (!(image.depth_unit_m > 0.0 && image.depth_unit_m <= 1.0))
          return fail(ErrorCode::kFormat, "depth_scale = {} is out of range", scale);
        if (object.has("cam_R_w2c")) {
          TURNSCAN_ASSIGN(image.T_camera_place, bop_pose(object, "w2c"));
        }
        out[number] = image;
        return {};
      }));
  if (out.empty()) return fail_at(path.string(), ErrorCode::kTooFewPoints, "it lists no images");
  return out;
}

bool all_placed(const BopImages& images) {
  return std::all_of(images.begin(), images.end(),
                     [](const auto& image) { return image.second.T_camera_place.has_value(); });
}

/// Places the images by the one object that they show, if they all show the same one.
Result<> place_by_object(const fs::path& path, BopImages& images, const RunContext& context) {
  for (auto& [number, image] : images) image.T_camera_place.reset();
  std::optional<double> object_id;
  TURNSCAN_TRY(for_each_image(
      path, context,
      [&](std::uint32_t number, const text::Json& value, const text::JsonPlace& place) -> Result<> {
        const auto image = images.find(number);
        if (image == images.end()) return {};
        if (!value.is_array() || value.size() != 1)
          return fail(ErrorCode::kUnsupported,
                      "{}: the image shows {} objects, and nothing says how the camera moved "
                      "(cam_R_w2c); a scene of one object is needed",
                      place.shown(), value.is_array() ? value.size() : 0);
        TURNSCAN_ASSIGN(const JsonObject object, JsonObject::from(value[0], place.element(0)));
        TURNSCAN_ASSIGN(const double id, object.number("obj_id"));
        if (object_id.value_or(id) != id)
          return fail(ErrorCode::kUnsupported, "{}: the images show different objects",
                      place.shown());
        object_id = id;
        TURNSCAN_ASSIGN(image->second.T_camera_place, bop_pose(object, "m2c"));
        return {};
      }));
  if (all_placed(images)) return {};
  return fail_at(path.string(), ErrorCode::kMissingData,
                 "images of scene_camera.json have no pose here");
}

Result<fs::path> bop_color(const fs::path& folder, std::uint32_t number) {
  for (const char* name : {"rgb", "gray"}) {
    for (const char* ending : {"png", "jpg"}) {
      fs::path path = folder / name / fmt::format("{:06}.{}", number, ending);
      TURNSCAN_ASSIGN(const bool there, file::is_there(path));
      if (there) return path;
    }
  }
  return fs::path();
}

/// What the masks of the visible parts show, mask_visib/IMAGE_OBJECT.png, is the scene's subject.
Result<> take_masks(const fs::path& folder, std::vector<ForeignFrame>& frames,
                    SequenceHeader& header) {
  const fs::path masks = folder / "mask_visib";
  std::error_code error;
  if (!fs::is_directory(masks, error)) return {};
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(masks));
  std::map<std::string, std::vector<fs::path>> of_image;
  for (const std::string& name : names)
    if (name.ends_with(".png")) of_image[name.substr(0, name.find('_'))].push_back(masks / name);
  for (ForeignFrame& frame : frames) {
    frame.masks = of_image[fmt::format("{:06}", frame.info.index)];
    if (frame.masks.empty())
      return fail_at(masks.string(), ErrorCode::kMissingData,
                     "image {} has no mask here; move the folder away to take all of its depth",
                     frame.info.index);
  }
  add_note(header,
           "depth was taken where mask_visib shows an object; move that folder away to take all");
  return {};
}

SensorInfo sensor_of(const BopImage& image, int width, int height) {
  SensorInfo sensor;
  sensor.depth_unit_m = image.depth_unit_m;
  CameraIntrinsics& camera = sensor.intrinsics;
  camera.width = width, camera.height = height;
  camera.fx = image.fx, camera.fy = image.fy, camera.cx = image.cx, camera.cy = image.cy;
  return sensor;
}

Result<std::vector<ForeignFrame>> list_bop_frames(const fs::path& folder, const BopImages& images,
                                                  const ImportOptions& options,
                                                  SequenceHeader& header,
                                                  const RunContext& context) {
  std::vector<ForeignFrame> frames;
  std::vector<std::optional<Pose>> poses;
  SceneSensors sensors;
  std::optional<std::pair<int, int>> size;
  for (const auto& [number, image] : images) {
    TURNSCAN_TRY(context.check());
    ForeignFrame& frame = frames.emplace_back();
    frame.info.index = number;
    frame.info.file = fmt::format("depth/{:06}.png", number);
    TURNSCAN_ASSIGN(frame.data, existing_file(folder, frame.info.file, "scene_camera.json"));
    TURNSCAN_ASSIGN(frame.color, bop_color(folder, number));
    if (!size) {
      TURNSCAN_ASSIGN(const DepthImage depth, read_depth_png(frame.data));
      size = {depth.width, depth.height};
    }
    TURNSCAN_ASSIGN(frame.info.sensor,
                    sensors.number_of(sensor_of(image, size->first, size->second)));
    TURNSCAN_ASSIGN(poses.emplace_back(), placed_pose(image.T_camera_place->inverse(), options));
  }
  TURNSCAN_TRY(place_frames(poses, frames));
  header.sensors = sensors.take();
  return frames;
}

}  // namespace

OpenResult open_bop(const fs::path& folder, const ImportOptions& options,
                    const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("BOP scene {}", display_name(folder));
  TURNSCAN_ASSIGN(BopImages images,
                  read_bop_cameras(folder / "scene_camera.json", options, context));
  if (!all_placed(images)) {
    TURNSCAN_TRY(place_by_object(folder / "scene_gt.json", images, context));
    add_note(header, "the frames are placed by the object's pose in scene_gt.json");
  }
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames,
                  list_bop_frames(folder, images, options, header, context));
  TURNSCAN_TRY(take_masks(folder, frames, header));
  TURNSCAN_TRY(look_at_first_images(header, frames));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames);
}

}  // namespace turnscan::importers
