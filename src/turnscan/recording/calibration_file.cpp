#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/utc_time.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/recording/calibration_file.hpp>

namespace turnscan::recording_format {

namespace {

constexpr const char* kCalibrationFormat = "turnscan calibration";
constexpr int kCalibrationSchema = 1;
constexpr std::uint64_t kMaxCalibrationBytes = std::uint64_t(256) << 20;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

double radians_of(double degrees) { return degrees / kDegreesPerRadian; }

/// Degrees that convert back to exactly these radians, if there are any.
double degrees_of(double radians) {
  const double near = radians * kDegreesPerRadian;
  double up = near, down = near;
  for (int i = 0; i < 4; ++i) {
    if (radians_of(up) == radians) return up;
    if (radians_of(down) == radians) return down;
    up = std::nextafter(up, 1e300);
    down = std::nextafter(down, -1e300);
  }
  return near;
}

/// JSON has no NaN: unknown values are null.
text::OrderedJson known(double value) {
  return std::isfinite(value) ? text::OrderedJson(value) : text::OrderedJson();
}
text::OrderedJson known_degrees(double radians) {
  return std::isfinite(radians) ? text::OrderedJson(degrees_of(radians)) : text::OrderedJson();
}

Result<double> known_number(const text::JsonObject& object, const char* key) {
  TURNSCAN_ASSIGN(const auto value, object.optional_number(key));
  return value.value_or(kNotKnown);
}

void put_text(text::OrderedJson& out, const char* key, const std::string& text) {
  if (!text.empty()) out[key] = text;
}

void put_sigmas(text::OrderedJson& out, const Calibration& c) {
  out["axis_sigma_deg"] = known_degrees(c.axis_sigma_rad);
  out["center_sigma_m"] = known(c.center_sigma_m);
  out["height_sigma_m"] = known(c.height_sigma_m);
  out["radius_sigma_m"] = known(c.radius_sigma_m);
  out["speed_sigma_deg_s"] = known_degrees(c.speed_sigma_rad_s);
}

void put_reasons(text::OrderedJson& out, const Calibration& c) {
  put_text(out, "axis_found", c.axis_found);
  put_text(out, "center_found", c.center_found);
  put_text(out, "height_found", c.height_found);
  put_text(out, "radius_found", c.radius_found);
  put_text(out, "speed_found", c.speed_found);
  put_text(out, "angles_found", c.angles_found);
}

void put_angles(text::OrderedJson& out, const Calibration& c) {
  if (c.angles_rad.empty()) return;
  out["angles_deg"] = text::OrderedJson::array();
  out["angles_sigma_deg"] = text::OrderedJson::array();
  for (const double a : c.angles_rad) out["angles_deg"].push_back(degrees_of(a));
  for (const double s : c.angle_sigma_rad) out["angles_sigma_deg"].push_back(known_degrees(s));
}

text::OrderedJson depth_json(const DepthCorrection& depth) {
  auto out = text::OrderedJson::object();
  out["bias_m"] = depth.bias_m;
  out["scale"] = depth.scale;
  out["bias_sigma_m"] = known(depth.bias_sigma_m);
  out["scale_sigma"] = known(depth.scale_sigma);
  put_text(out, "found", depth.found);
  return out;
}

Result<DepthCorrection> parse_depth(const text::JsonObject& object) {
  DepthCorrection depth;
  TURNSCAN_ASSIGN(depth.bias_m, object.number("bias_m"));
  TURNSCAN_ASSIGN(depth.scale, object.number_or("scale", 1.0));
  TURNSCAN_ASSIGN(depth.bias_sigma_m, known_number(object, "bias_sigma_m"));
  TURNSCAN_ASSIGN(depth.scale_sigma, known_number(object, "scale_sigma"));
  TURNSCAN_ASSIGN(depth.found, object.text_or("found", ""));
  if (!(depth.scale > 0.1 && depth.scale < 10.0) || std::abs(depth.bias_m) > 10.0)
    return fail(ErrorCode::kFormat, "the correction of depth is beyond 10 times or 10 m");
  return depth;
}

text::OrderedJson camera_json(const CameraCorrection& camera) {
  auto out = text::OrderedJson::object();
  out["intrinsics"] = text::json_of(camera.intrinsics);
  if (camera.color_intrinsics) {
    out["color_intrinsics"] = text::json_of(*camera.color_intrinsics);
    out["T_color_sensor"] = text::json_of(camera.T_color_sensor);
  }
  put_text(out, "found", camera.found);
  return out;
}

Result<CameraCorrection> parse_camera(const text::JsonObject& object) {
  CameraCorrection camera;
  TURNSCAN_ASSIGN(const text::JsonObject intrinsics, object.object("intrinsics"));
  TURNSCAN_ASSIGN(camera.intrinsics, text::intrinsics_from_json(intrinsics));
  if (object.has("color_intrinsics")) {
    TURNSCAN_ASSIGN(const text::JsonObject color, object.object("color_intrinsics"));
    TURNSCAN_ASSIGN(camera.color_intrinsics, text::intrinsics_from_json(color));
    TURNSCAN_ASSIGN(camera.T_color_sensor, object.pose("T_color_sensor"));
  }
  TURNSCAN_ASSIGN(camera.found, object.text_or("found", ""));
  return camera;
}

/// Parses the corrections that exist.
Result<> parse_corrections(const text::JsonObject& object, std::optional<DepthCorrection>& depth,
                           std::optional<CameraCorrection>& camera) {
  if (object.has("depth")) {
    TURNSCAN_ASSIGN(const text::JsonObject part, object.object("depth"));
    TURNSCAN_ASSIGN(depth, parse_depth(part));
  }
  if (object.has("camera")) {
    TURNSCAN_ASSIGN(const text::JsonObject part, object.object("camera"));
    TURNSCAN_ASSIGN(camera, parse_camera(part));
  }
  return {};
}

text::OrderedJson place_json(const SensorPlace& place) {
  auto out = text::OrderedJson::object();
  out["T_table_sensor"] = text::json_of(place.T_table_sensor);
  out["heading_sigma_deg"] = known_degrees(place.heading_sigma_rad);
  out["shift_sigma_m"] = known(place.shift_sigma_m);
  put_text(out, "found", place.found);
  if (place.depth) out["depth"] = depth_json(*place.depth);
  if (place.camera) out["camera"] = camera_json(*place.camera);
  return out;
}

Result<std::vector<SensorPlace>> parse_places(const text::JsonObject& root) {
  std::vector<SensorPlace> out;
  if (!root.has("other_sensors")) return out;
  TURNSCAN_ASSIGN(const std::vector<text::JsonObject> objects, root.objects("other_sensors"));
  for (const text::JsonObject& object : objects) {
    SensorPlace place;
    TURNSCAN_ASSIGN(place.T_table_sensor, object.pose("T_table_sensor"));
    TURNSCAN_ASSIGN(const double heading_deg, known_number(object, "heading_sigma_deg"));
    place.heading_sigma_rad = radians_of(heading_deg);
    TURNSCAN_ASSIGN(place.shift_sigma_m, known_number(object, "shift_sigma_m"));
    TURNSCAN_ASSIGN(place.found, object.text_or("found", ""));
    TURNSCAN_TRY(parse_corrections(object, place.depth, place.camera));
    out.push_back(std::move(place));
  }
  return out;
}

Result<TurntableInfo> parse_table(const text::JsonObject& object) {
  TurntableInfo table;
  TURNSCAN_ASSIGN(table.axis, object.vector("axis"));
  TURNSCAN_ASSIGN(table.center_m, object.vector("center_m"));
  TURNSCAN_ASSIGN(table.radius_m, object.optional_number("radius_m"));
  TURNSCAN_ASSIGN(table.reach_m, object.optional_number("reach_m"));
  TURNSCAN_ASSIGN(table.speed_rad_s, object.optional_number("speed_rad_s"));
  TURNSCAN_ASSIGN(const auto degrees, object.optional_number("speed_deg_s"));
  if (degrees) table.speed_rad_s = radians_of(*degrees);
  const double length = table.axis.norm();
  if (!(length > 1e-6 && length < 1e6) || (table.radius_m && !(*table.radius_m > 0.0)) ||
      (table.reach_m && !(*table.reach_m > 0.0)))
    return fail(ErrorCode::kFormat,
                "the axis has no length, or one beyond all measure, or the radius or the reach is "
                "not positive");
  if (!(table.center_m.norm() < 1e6))
    return fail(ErrorCode::kFormat, "the centre lies beyond all measure");
  // A unit vector is preserved to the last bit.
  if (std::abs(table.axis.norm() - 1.0) > 1e-14) table.axis.normalize();
  return table;
}

/// A list of numbers of which some may be null.
Result<std::vector<double>> known_numbers(const text::JsonObject& object, const char* key) {
  std::vector<double> out;
  const text::Json* list = object.find(key);
  if (list == nullptr) return out;
  if (!list->is_array()) return fail(ErrorCode::kFormat, "{} is not a list", object.place_of(key));
  for (const text::Json& value : *list) {
    if (!value.is_number() && !value.is_null())
      return fail(ErrorCode::kFormat, "{} holds something that is no number", object.place_of(key));
    out.push_back(value.is_null() ? kNotKnown : radians_of(value.get<double>()));
  }
  return out;
}

Result<> parse_angles(const text::JsonObject& object, Calibration& c) {
  TURNSCAN_ASSIGN(c.angles_rad, known_numbers(object, "angles_deg"));
  TURNSCAN_ASSIGN(c.angle_sigma_rad, known_numbers(object, "angles_sigma_deg"));
  for (const double a : c.angles_rad) {
    if (!std::isfinite(a)) return fail(ErrorCode::kFormat, "an angle is not known");
  }
  if (!c.angle_sigma_rad.empty() && c.angle_sigma_rad.size() != c.angles_rad.size())
    return fail(ErrorCode::kFormat, "angles_deg and angles_sigma_deg differ in length");
  return {};
}

Result<CalibrationMethod> parse_method(const text::JsonObject& object) {
  TURNSCAN_ASSIGN(const std::string text, object.text_or("method", ""));
  for (const auto method :
       {CalibrationMethod::kPicked, CalibrationMethod::kDetected, CalibrationMethod::kMotion}) {
    if (text == name_of(method)) return method;
  }
  return fail(ErrorCode::kFormat, "method '{}' is not known", text);
}

Result<> parse_figures(const text::JsonObject& root, Calibration& c) {
  TURNSCAN_ASSIGN(const double axis_sigma_deg, known_number(root, "axis_sigma_deg"));
  c.axis_sigma_rad = radians_of(axis_sigma_deg);
  TURNSCAN_ASSIGN(c.center_sigma_m, known_number(root, "center_sigma_m"));
  TURNSCAN_ASSIGN(c.height_sigma_m, known_number(root, "height_sigma_m"));
  TURNSCAN_ASSIGN(c.radius_sigma_m, known_number(root, "radius_sigma_m"));
  TURNSCAN_ASSIGN(const double speed_sigma_deg, known_number(root, "speed_sigma_deg_s"));
  c.speed_sigma_rad_s = radians_of(speed_sigma_deg);
  TURNSCAN_ASSIGN(c.start_s, root.optional_number("start_s"));
  TURNSCAN_ASSIGN(c.residual_rms_m, known_number(root, "residual_rms_m"));
  TURNSCAN_ASSIGN(c.residual_mean_abs_m, known_number(root, "residual_mean_abs_m"));
  TURNSCAN_ASSIGN(c.rim_share, known_number(root, "rim_share"));
  TURNSCAN_ASSIGN(c.confidence, known_number(root, "confidence"));
  return {};
}

Result<> parse_reasons(const text::JsonObject& root, Calibration& c) {
  TURNSCAN_ASSIGN(c.axis_found, root.text_or("axis_found", ""));
  TURNSCAN_ASSIGN(c.center_found, root.text_or("center_found", ""));
  TURNSCAN_ASSIGN(c.height_found, root.text_or("height_found", ""));
  TURNSCAN_ASSIGN(c.radius_found, root.text_or("radius_found", ""));
  TURNSCAN_ASSIGN(c.speed_found, root.text_or("speed_found", ""));
  TURNSCAN_ASSIGN(c.angles_found, root.text_or("angles_found", ""));
  if (root.has("undetermined")) {
    TURNSCAN_ASSIGN(c.undetermined, root.texts("undetermined"));
  }
  if (root.has("notes")) {
    TURNSCAN_ASSIGN(c.notes, root.texts("notes"));
  }
  return {};
}

Result<std::string> parse_date(const text::JsonObject& root) {
  TURNSCAN_ASSIGN(std::string date, root.text_or("made_at", ""));
  if (!date.empty() && !utc_seconds(date))
    return fail(ErrorCode::kFormat, "made_at '{}' is no date in UTC like 2026-11-24T08:30:00Z",
                date);
  return date;
}

Result<Calibration> parse_whole(const text::JsonObject& root) {
  TURNSCAN_ASSIGN(const int schema, root.integer("schema_version", 1, 1 << 30));
  if (schema > kCalibrationSchema)
    return fail(ErrorCode::kUnsupported,
                "the calibration has schema version {}, but this program knows versions up to {}; "
                "update turnscan to read it",
                schema, kCalibrationSchema);
  Calibration c;
  TURNSCAN_ASSIGN(c.method, parse_method(root));
  TURNSCAN_ASSIGN(c.made_at, parse_date(root));
  TURNSCAN_ASSIGN(c.table, parse_table(root));
  TURNSCAN_TRY(parse_figures(root, c));
  TURNSCAN_TRY(parse_reasons(root, c));
  TURNSCAN_TRY(parse_angles(root, c));
  TURNSCAN_TRY(parse_corrections(root, c.depth, c.camera));
  TURNSCAN_ASSIGN(c.others, parse_places(root));
  return c;
}

}  // namespace

}  // namespace turnscan::recording_format

namespace turnscan {

using namespace recording_format;

std::string calibration_json(const Calibration& c) {
  auto out = text::OrderedJson::object();
  out["format"] = kCalibrationFormat;
  out["schema_version"] = kCalibrationSchema;
  out["method"] = std::string(name_of(c.method));
  put_text(out, "made_at", c.made_at);
  out["axis"] = text::json_of(c.table.axis);
  out["center_m"] = text::json_of(c.table.center_m);
  if (c.table.radius_m) out["radius_m"] = *c.table.radius_m;
  if (c.table.reach_m) out["reach_m"] = *c.table.reach_m;
  if (c.table.speed_rad_s) out["speed_deg_s"] = degrees_of(*c.table.speed_rad_s);
  put_sigmas(out, c);
  put_reasons(out, c);
  if (c.start_s) out["start_s"] = *c.start_s;
  out["residual_rms_m"] = known(c.residual_rms_m);
  out["residual_mean_abs_m"] = known(c.residual_mean_abs_m);
  out["rim_share"] = known(c.rim_share);
  out["confidence"] = known(c.confidence);
  out["undetermined"] = c.undetermined;
  if (!c.notes.empty()) out["notes"] = c.notes;
  if (c.depth) out["depth"] = depth_json(*c.depth);
  if (c.camera) out["camera"] = camera_json(*c.camera);
  if (!c.others.empty()) out["other_sensors"] = text::OrderedJson::array();
  for (const SensorPlace& place : c.others) out["other_sensors"].push_back(place_json(place));
  put_angles(out, c);
  return text::json_text(out);
}

Result<Calibration> parse_calibration(std::string_view text) {
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text));
  TURNSCAN_ASSIGN(text::JsonObject root, text::JsonObject::from(json, text));
  TURNSCAN_ASSIGN(const std::string format, root.text_or("format", ""));
  if (format == kCalibrationFormat) return parse_whole(root);
  if (root.has("turntable")) {
    TURNSCAN_ASSIGN(root, root.object("turntable"));
  }
  Calibration c;
  TURNSCAN_ASSIGN(c.table, parse_table(root));
  c.axis_found = c.center_found = "given in a file";
  return c;
}

Result<Calibration> read_calibration(const std::filesystem::path& path) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxCalibrationBytes));
  auto calibration = parse_calibration(text);
  if (!calibration)
    return fail_at(path.string(), calibration.error().code,
                   "not a calibration: {}; write it as in docs/reference/calibration.md",
                   calibration.error().message);
  return calibration;
}

Result<> write_calibration(const std::filesystem::path& path, const Calibration& calibration) {
  return write_file_atomically(path, calibration_json(calibration));
}

}  // namespace turnscan
