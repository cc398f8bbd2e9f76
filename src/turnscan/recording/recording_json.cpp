#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/recording/recording_json.hpp>

namespace turnscan::recording_format {

namespace {

constexpr const char* kRecordingFormat = "turnscan recording";
constexpr std::size_t kMaxSensors = 64;
constexpr double kMaxSpeed_rad_s = 1e4;

Result<SensorKind> parse_kind(const text::JsonObject& object) {
  TURNSCAN_ASSIGN(const std::string kind, object.text_or("kind", "depth-camera"));
  if (kind == "depth-camera") return SensorKind::kDepthCamera;
  if (kind == "point-scanner") return SensorKind::kPointScanner;
  return fail(ErrorCode::kFormat, "{} is '{}', neither depth-camera nor point-scanner",
              object.place_of("kind"), kind);
}

Result<Viewpoint> parse_viewpoint(const text::JsonObject& object) {
  Viewpoint viewpoint;
  viewpoint.parallel = object.has("parallel_direction");
  if (!viewpoint.parallel) {
    TURNSCAN_ASSIGN(viewpoint.value, object.vector("position_m"));
    return viewpoint;
  }
  TURNSCAN_ASSIGN(const Vec3d direction, object.vector("parallel_direction"));
  if (!(direction.norm() > 1e-6))
    return fail(ErrorCode::kFormat, "{} has no length", object.place_of("parallel_direction"));
  viewpoint.value = direction.normalized();
  return viewpoint;
}

Result<> parse_color(const text::JsonObject& object, SensorInfo& sensor) {
  TURNSCAN_ASSIGN(const bool registered, object.flag_or("registered", true));
  if (registered) return {};
  TURNSCAN_ASSIGN(const text::JsonObject intrinsics, object.object("intrinsics"));
  TURNSCAN_ASSIGN(sensor.color_intrinsics, text::intrinsics_from_json(intrinsics));
  TURNSCAN_ASSIGN(sensor.T_color_sensor, object.pose("T_color_sensor"));
  return {};
}

Result<SensorInfo> parse_sensor(const text::JsonObject& object) {
  SensorInfo sensor;
  TURNSCAN_ASSIGN(sensor.kind, parse_kind(object));
  TURNSCAN_ASSIGN(sensor.model, object.text_or("model", ""));
  if (sensor.kind == SensorKind::kDepthCamera) {
    TURNSCAN_ASSIGN(const text::JsonObject intrinsics, object.object("intrinsics"));
    TURNSCAN_ASSIGN(sensor.intrinsics, text::intrinsics_from_json(intrinsics));
    TURNSCAN_ASSIGN(sensor.depth_unit_m, object.number("depth_unit_m"));
    TURNSCAN_ASSIGN(sensor.depth_bias_m, object.number_or("depth_bias_m", 0.0));
  }
  if (object.has("T_table_sensor")) {
    TURNSCAN_ASSIGN(sensor.T_table_sensor, object.pose("T_table_sensor"));
  }
  if (object.has("viewpoint")) {
    TURNSCAN_ASSIGN(const text::JsonObject viewpoint, object.object("viewpoint"));
    TURNSCAN_ASSIGN(sensor.viewpoint, parse_viewpoint(viewpoint));
  }
  if (object.has("color")) {
    TURNSCAN_ASSIGN(const text::JsonObject color, object.object("color"));
    TURNSCAN_TRY(parse_color(color, sensor));
  }
  return sensor;
}

Result<TurntableInfo> parse_turntable(const text::JsonObject& object) {
  TurntableInfo table;
  TURNSCAN_ASSIGN(table.axis, object.vector("axis"));
  if (!(table.axis.norm() > 1e-6))
    return fail(ErrorCode::kFormat, "{} has no length", object.place_of("axis"));
  table.axis.normalize();
  TURNSCAN_ASSIGN(table.center_m, object.vector("center_m"));
  TURNSCAN_ASSIGN(table.radius_m, object.optional_number("radius_m"));
  TURNSCAN_ASSIGN(table.reach_m, object.optional_number("reach_m"));
  TURNSCAN_ASSIGN(table.speed_rad_s, object.optional_number("speed_rad_s"));
  return table;
}

Result<CaptureSettings> parse_capture(const text::JsonObject& root) {
  CaptureSettings settings;
  const text::Json* capture = root.find("capture");
  if (capture == nullptr || !capture->is_object()) return settings;
  for (const auto& item : capture->items()) {
    settings[item.key()] =
        item.value().is_string()
            ? item.value().get<std::string>()
            : item.value().dump(-1, ' ', false, text::Json::error_handler_t::replace);
  }
  return settings;
}

/// The first line of SequenceHeader::source is the origin, each further line an assumption.
Result<std::string> parse_source(const text::JsonObject& root) {
  TURNSCAN_ASSIGN(std::string source, root.text_or("source", ""));
  if (!root.has("notes")) return source;
  TURNSCAN_ASSIGN(const std::vector<std::string> notes, root.texts("notes"));
  for (const std::string& note : notes) source += "\n" + note;
  return source;
}

Result<> check_schema(const text::JsonObject& root) {
  TURNSCAN_ASSIGN(const std::string format, root.text_or("format", ""));
  if (format != kRecordingFormat)
    return fail(ErrorCode::kFormat, "this is not the description of a turnscan recording");
  TURNSCAN_ASSIGN(const int schema, root.integer("schema_version", 1, 1 << 30));
  if (schema > kRecordingSchema)
    return fail(ErrorCode::kUnsupported,
                "the recording has schema version {}, but this program knows versions up to {}; "
                "update turnscan to read it",
                schema, kRecordingSchema);
  return {};
}

Result<SequenceHeader> parse_header(const text::JsonObject& root) {
  SequenceHeader header;
  TURNSCAN_ASSIGN(header.software, root.text_or("software", ""));
  TURNSCAN_ASSIGN(header.source, parse_source(root));
  TURNSCAN_ASSIGN(const std::vector<text::JsonObject> sensors, root.objects("sensors"));
  if (sensors.empty() || sensors.size() > kMaxSensors)
    return fail(ErrorCode::kFormat, "there are {} sensors, not 1 to {}", sensors.size(),
                kMaxSensors);
  for (const text::JsonObject& object : sensors) {
    TURNSCAN_ASSIGN(SensorInfo sensor, parse_sensor(object));
    header.sensors.push_back(std::move(sensor));
  }
  if (root.has("turntable")) {
    TURNSCAN_ASSIGN(const text::JsonObject object, root.object("turntable"));
    TURNSCAN_ASSIGN(header.turntable, parse_turntable(object));
  }
  TURNSCAN_ASSIGN(header.poses_within_pass, root.flag_or("poses_within_pass", false));
  return header;
}

text::OrderedJson viewpoint_json(const Viewpoint& viewpoint) {
  return {
      {viewpoint.parallel ? "parallel_direction" : "position_m", text::json_of(viewpoint.value)}};
}

text::OrderedJson sensor_json(const SensorInfo& sensor) {
  text::OrderedJson out = sensor_kind_json(sensor);
  if (sensor.T_table_sensor) out["T_table_sensor"] = text::json_of(*sensor.T_table_sensor);
  out["viewpoint"] = viewpoint_json(sensor.viewpoint);
  text::OrderedJson color = {{"registered", !sensor.color_intrinsics}};
  if (sensor.color_intrinsics) {
    color["intrinsics"] = text::json_of(*sensor.color_intrinsics);
    color["T_color_sensor"] = text::json_of(sensor.T_color_sensor);
  }
  out["color"] = std::move(color);
  return out;
}

void put_source(const std::string& source, text::OrderedJson& out) {
  std::size_t end = source.find('\n');
  out["source"] = source.substr(0, end);
  text::OrderedJson notes = text::OrderedJson::array();
  while (end != std::string::npos) {
    const std::size_t begin = end + 1;
    end = source.find('\n', begin);
    notes.push_back(source.substr(begin, end - begin));
  }
  if (!notes.empty()) out["notes"] = notes;
}

/// Empty if the sensor is usable, else its defect.
std::string defect_of(const SensorInfo& s) {
  if (!s.viewpoint.value.allFinite() || s.viewpoint.value.norm() > kMaxDistance_m)
    return "its viewpoint is not within 1000 km";
  if (s.viewpoint.parallel && !(s.viewpoint.value.norm() > 1e-6))
    return "its parallel viewing direction has no length";
  // Same checks as the reader: what it rejects must not be written.
  if (s.T_table_sensor)
    if (const auto good = pose_from(s.T_table_sensor->matrix()); !good)
      return "its T_table_sensor: " + good.error().message;
  if (s.color_intrinsics) {
    if (const auto good = s.color_intrinsics->check(); !good) return good.error().message;
    if (const auto good = pose_from(s.T_color_sensor.matrix()); !good)
      return "its T_color_sensor: " + good.error().message;
  }
  if (s.kind == SensorKind::kPointScanner) return "";
  if (const auto good = s.intrinsics.check(); !good) return good.error().message;
  if (!(s.depth_unit_m > 0.0 && s.depth_unit_m <= 1.0))
    return fmt::format("its depth unit {} m is not within 0 to 1 m", s.depth_unit_m);
  if (!(std::abs(s.depth_bias_m) <= kMaxDistance_m)) return "its depth bias is not within 1000 km";
  return "";
}

std::string defect_of(const TurntableInfo& table) {
  if (!table.axis.allFinite() || !(table.axis.norm() > 1e-6)) return "its axis has no direction";
  if (!table.center_m.allFinite() || table.center_m.norm() > kMaxDistance_m)
    return "its centre is not within 1000 km";
  for (const auto& [name, value] : {std::pair("radius", table.radius_m), {"reach", table.reach_m}})
    if (value && !(*value > 0.0 && *value <= kMaxDistance_m))
      return fmt::format("its {} {} m is not within 0 to 1000 km", name, *value);
  if (table.speed_rad_s && !(std::abs(*table.speed_rad_s) <= kMaxSpeed_rad_s))
    return fmt::format("its speed {:.3g} rad/s is beyond {:.0e} rad/s", *table.speed_rad_s,
                       kMaxSpeed_rad_s);
  return "";
}

}  // namespace

text::OrderedJson sensor_kind_json(const SensorInfo& sensor) {
  const bool camera = sensor.kind == SensorKind::kDepthCamera;
  auto out = text::OrderedJson::object();
  out["kind"] = camera ? "depth-camera" : "point-scanner";
  out["model"] = sensor.model;
  if (camera) {
    out["intrinsics"] = text::json_of(sensor.intrinsics);
    out["depth_unit_m"] = sensor.depth_unit_m;
    out["depth_bias_m"] = sensor.depth_bias_m;
  }
  return out;
}

text::OrderedJson turntable_json(const TurntableInfo& table) {
  auto out = text::OrderedJson::object();
  out["axis"] = text::json_of(table.axis);
  out["center_m"] = text::json_of(table.center_m);
  if (table.radius_m) out["radius_m"] = *table.radius_m;
  if (table.reach_m) out["reach_m"] = *table.reach_m;
  if (table.speed_rad_s) out["speed_rad_s"] = *table.speed_rad_s;
  return out;
}

Result<> check_header(const SequenceHeader& header) {
  if (header.sensors.empty() || header.sensors.size() > kMaxSensors)
    return fail(ErrorCode::kInvalidOption, "recording: there are {} sensors, not 1 to {}",
                header.sensors.size(), kMaxSensors);
  for (std::size_t i = 0; i < header.sensors.size(); ++i) {
    if (const std::string defect = defect_of(header.sensors[i]); !defect.empty())
      return fail(ErrorCode::kInvalidOption, "recording: sensor {}: {}", i, defect);
  }
  if (!header.turntable) return {};
  if (const std::string defect = defect_of(*header.turntable); !defect.empty())
    return fail(ErrorCode::kInvalidOption, "recording: turntable: {}", defect);
  return {};
}

Result<RecordingDescription> parse_recording_json(std::string_view text) {
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(json, text));
  TURNSCAN_TRY(check_schema(root));
  RecordingDescription out;
  TURNSCAN_ASSIGN(out.header, parse_header(root));
  TURNSCAN_ASSIGN(out.capture, parse_capture(root));
  TURNSCAN_ASSIGN(out.complete, root.flag_or("complete", true));
  if (root.has("frame_count")) {
    TURNSCAN_ASSIGN(const int count, root.integer("frame_count", 0, 1 << 30));
    out.frame_count = static_cast<std::uint32_t>(count);
  }
  if (root.has("resumed_at")) {
    TURNSCAN_ASSIGN(const std::vector<double> indices, root.numbers("resumed_at"));
    for (const double index : indices) {
      if (!(index >= 0.0 && index < double(1 << 30)))
        return fail(ErrorCode::kFormat, "{} holds {}, which is no index of a frame",
                    root.place_of("resumed_at"), index);
      out.resumed_at.push_back(static_cast<std::uint32_t>(index));
    }
    std::sort(out.resumed_at.begin(), out.resumed_at.end());
  }
  if (const auto good = check_header(out.header); !good)
    return fail(ErrorCode::kFormat, "{}", good.error().message);
  return out;
}

std::string recording_json(const RecordingDescription& description) {
  const SequenceHeader& header = description.header;
  auto out = text::OrderedJson::object();
  out["format"] = kRecordingFormat;
  out["schema_version"] = kRecordingSchema;
  out["software"] = header.software;
  put_source(header.source, out);
  out["complete"] = description.complete;
  if (description.frame_count) out["frame_count"] = *description.frame_count;
  if (!description.resumed_at.empty()) out["resumed_at"] = description.resumed_at;
  out["sensors"] = text::OrderedJson::array();
  for (const SensorInfo& sensor : header.sensors) out["sensors"].push_back(sensor_json(sensor));
  if (header.turntable) out["turntable"] = turntable_json(*header.turntable);
  if (header.poses_within_pass) out["poses_within_pass"] = true;
  if (!description.capture.empty()) out["capture"] = description.capture;
  return text::json_text(out);
}

}  // namespace turnscan::recording_format
