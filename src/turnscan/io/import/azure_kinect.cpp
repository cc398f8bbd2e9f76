#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <turnscan/io/import/azure_kinect.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace {

constexpr std::string_view kBrownConrady = "CALIBRATION_LensDistortionModelBrownConrady";
constexpr double kDefaultRadius = 1.7;  // the SDK's default, if the calibration does not state it

/// Images of a mode: the sensor's pixels after binning, cropped from this offset.
struct CameraMode {
  std::string_view name;
  int binned_width, binned_height, left, top, width, height;
};

constexpr std::array<CameraMode, 4> kDepthModes{{{"NFOV_UNBINNED", 1024, 1024, 192, 180, 640, 576},
                                                 {"NFOV_2X2BINNED", 512, 512, 96, 90, 320, 288},
                                                 {"WFOV_2X2BINNED", 512, 512, 0, 0, 512, 512},
                                                 {"WFOV_UNBINNED", 1024, 1024, 0, 0, 1024, 1024}}};
constexpr std::array<CameraMode, 6> kColorModes{{{"720P", 1280, 960, 0, 120, 1280, 720},
                                                 {"1080P", 1920, 1440, 0, 180, 1920, 1080},
                                                 {"1440P", 2560, 1920, 0, 240, 2560, 1440},
                                                 {"1536P", 2048, 1536, 0, 0, 2048, 1536},
                                                 {"2160P", 3840, 2880, 0, 360, 3840, 2160},
                                                 {"3072P", 4096, 3072, 0, 0, 4096, 3072}}};

template <std::size_t kCount>
const CameraMode* mode_with(const std::array<CameraMode, kCount>& modes, const ImageSize& size) {
  for (const CameraMode& mode : modes)
    if (mode.width == size.width && mode.height == size.height) return &mode;
  return nullptr;
}

struct RawCamera {
  CameraIntrinsics lens;  ///< fx, fy, cx, cy relative to width and height; size of the sensor
  double radius = kDefaultRadius;
  Pose T_camera_world = Pose::Identity();
};

Result<Pose> parse_placement(const text::JsonObject& camera) {
  TURNSCAN_ASSIGN(const text::JsonObject rt, camera.object("Rt"));
  TURNSCAN_ASSIGN(const std::vector<double> r, rt.numbers("Rotation"));
  TURNSCAN_ASSIGN(const std::vector<double> t, rt.numbers("Translation"));
  if (r.size() != 9 || t.size() != 3)
    return fail(ErrorCode::kFormat, "{} is no rotation of 9 and translation of 3 numbers",
                camera.place_of("Rt"));
  auto pose = text::pose_from_rows(
      {r[0], r[1], r[2], t[0], r[3], r[4], r[5], t[1], r[6], r[7], r[8], t[2], 0, 0, 0, 1});
  if (!pose) return fail(ErrorCode::kFormat, "{}: {}", camera.place_of("Rt"), pose.error().message);
  return *pose;
}

Result<RawCamera> parse_camera(const text::JsonObject& object) {
  RawCamera out;
  TURNSCAN_ASSIGN(out.lens.width, object.integer("SensorWidth", 1, 65535));
  TURNSCAN_ASSIGN(out.lens.height, object.integer("SensorHeight", 1, 65535));
  TURNSCAN_ASSIGN(const double radius, object.number_or("MetricRadius", 0.0));
  if (radius > 1e-4) out.radius = std::min(radius, 100.0);
  TURNSCAN_ASSIGN(out.T_camera_world, parse_placement(object));
  TURNSCAN_ASSIGN(const text::JsonObject intrinsics, object.object("Intrinsics"));
  TURNSCAN_ASSIGN(const std::string model, intrinsics.text_or("ModelType", ""));
  TURNSCAN_ASSIGN(const std::vector<double> p, intrinsics.numbers("ModelParameters"));
  if (model != kBrownConrady)
    return fail(ErrorCode::kUnsupported,
                "{} is '{}'; only {} is known, which all devices on sale have",
                intrinsics.place_of("ModelType"), model, kBrownConrady);
  if (p.size() < 14)
    return fail(ErrorCode::kFormat, "{} has {} numbers, not 14",
                intrinsics.place_of("ModelParameters"), p.size());
  if (p[10] != 0.0 || p[11] != 0.0)
    return fail(ErrorCode::kUnsupported, "{}: its centre of distortion is not the principal point",
                intrinsics.place_of("ModelParameters"));
  CameraIntrinsics& c = out.lens;
  c.cx = p[0], c.cy = p[1], c.fx = p[2], c.fy = p[3];
  c.distortion = {p[4], p[5], p[13], p[12], p[6], p[7], p[8], p[9]};
  return out;
}

/// Older calibrations of colour cameras refer to the 16:9 part of their 4:3 sensor.
void widen_to_4_3(CameraIntrinsics& c) {
  if (c.width * 9 / 16 != c.height) return;
  c.cy = (c.cy * 2304.0 + 384.0) / 3072.0;
  c.fy *= 2304.0 / 3072.0;
  c.height = c.width * 3 / 4;
}

/// In pixels of the mode's images, relative to the centre of the first one.
Result<CameraIntrinsics> in_mode(const CameraIntrinsics& unit, const CameraMode& mode) {
  CameraIntrinsics out = unit;
  out.width = mode.width, out.height = mode.height;
  out.fx = unit.fx * mode.binned_width;
  out.fy = unit.fy * mode.binned_height;
  out.cx = unit.cx * mode.binned_width - mode.left - 0.5;
  out.cy = unit.cy * mode.binned_height - mode.top - 0.5;
  TURNSCAN_TRY(out.check());
  return out;
}

Result<std::optional<RawCamera>> camera_at(const std::vector<text::JsonObject>& cameras,
                                           std::string_view location) {
  for (const text::JsonObject& camera : cameras) {
    TURNSCAN_ASSIGN(const std::string place, camera.text_or("Location", ""));
    if (place != location) continue;
    TURNSCAN_ASSIGN(RawCamera found, parse_camera(camera));
    return std::optional<RawCamera>(std::move(found));
  }
  return std::optional<RawCamera>();
}

}  // namespace

std::string_view azure_kinect_depth_mode(const ImageSize& size) {
  const CameraMode* mode = mode_with(kDepthModes, size);
  return mode == nullptr ? std::string_view() : mode->name;
}

Result<AzureKinectCameras> parse_azure_kinect(std::string_view json, const ImageSize& depth,
                                              const std::optional<ImageSize>& color) {
  const CameraMode* mode = mode_with(kDepthModes, depth);
  if (mode == nullptr)
    return fail(ErrorCode::kUnsupported, "no depth mode has images of {} x {} pixels", depth.width,
                depth.height);
  TURNSCAN_ASSIGN(const text::Json value, text::parse_json(json.substr(0, json.find('\0'))));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(value));
  TURNSCAN_ASSIGN(const text::JsonObject information, root.object("CalibrationInformation"));
  TURNSCAN_ASSIGN(const std::vector<text::JsonObject> cameras, information.objects("Cameras"));
  TURNSCAN_ASSIGN(const auto raw, camera_at(cameras, "CALIBRATION_CameraLocationD0"));
  if (!raw) return fail(ErrorCode::kFormat, "it does not describe a depth camera");
  if (raw->lens.width != 1024 || raw->lens.height != 1024)
    return fail(ErrorCode::kUnsupported, "its depth camera has {} x {} pixels, not 1024 x 1024",
                raw->lens.width, raw->lens.height);
  AzureKinectCameras out;
  TURNSCAN_ASSIGN(out.depth, in_mode(raw->lens, *mode));
  out.depth_radius = raw->radius;
  const CameraMode* color_mode = color ? mode_with(kColorModes, *color) : nullptr;
  if (color_mode == nullptr) return out;
  TURNSCAN_ASSIGN(auto raw_color, camera_at(cameras, "CALIBRATION_CameraLocationPV0"));
  if (!raw_color) return out;
  widen_to_4_3(raw_color->lens);
  if (raw_color->lens.width * 3 / 4 != raw_color->lens.height)
    return fail(ErrorCode::kUnsupported,
                "its colour camera has {} x {} pixels, neither 4:3 nor 16:9", raw_color->lens.width,
                raw_color->lens.height);
  TURNSCAN_ASSIGN(out.color, in_mode(raw_color->lens, *color_mode));
  out.T_color_depth = raw_color->T_camera_world * raw->T_camera_world.inverse();
  return out;
}

}  // namespace turnscan::importers
