#include <algorithm>
#include <turnscan/core/units.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/import_ros/ros_camera.hpp>
#include <turnscan/io/import_ros/ros_images.hpp>
#include <turnscan/io/import_ros/rosbag_streams.hpp>

namespace turnscan::importers {

namespace {

using rosbag::Bag;

constexpr std::string_view kData = "/image/data";

/// "/device_0/sensor_0/Depth_0" from its images' topic; empty for other topics.
std::string_view stream_of(std::string_view topic, std::string_view kind) {
  if (!topic.starts_with("/device_") || !topic.ends_with(kData)) return {};
  const std::string_view stream = topic.substr(0, topic.size() - kData.size());
  const std::size_t slash = stream.rfind('/');
  return stream.substr(slash + 1).starts_with(kind) ? stream : std::string_view();
}

/// The streams of this kind that contain images, sorted.
std::vector<std::string> streams_of(const Bag& bag, std::string_view kind) {
  std::vector<std::string> out;
  for (const auto& connection : bag.connections()) {
    const std::string_view stream = stream_of(connection.topic, kind);
    if (!stream.empty() && bag.first(connection.topic)) out.emplace_back(stream);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// "Name", "Serial Number", "Firmware Version", ... of the device.
std::string device_fact(const Bag& bag, std::string_view stream, std::string_view key) {
  const std::string device(stream.substr(0, stream.find('/', 1)));
  for (const auto& place : bag.messages(device + "/info")) {
    const auto message = bag.read(place);
    if (!message) continue;
    const auto fact = rosbag::parse_key_value(message->bytes, message->wire);
    if (fact && fact->key == key) return std::string(fact->value.substr(0, 100));
  }
  return {};
}

/// The model's preset if there is one, else the device's own model name.
std::string model_of(const std::string& name) {
  for (const char* number : {"D405", "D435", "D455"})
    if (name.find(number) != std::string::npos)
      return fmt::format("realsense-d4{}", std::string_view(number).substr(2));
  return name;
}

/// The shortest decimal with the same 24-bit value: 0.001, not 0.0010000000474974513.
Result<double> metres_of(float unit) {
  if (!(unit > 0.0f && unit < 1.0f))
    return fail(ErrorCode::kFormat, "the depth unit {} m is none; state it with --depth-unit",
                unit);
  return parse_number(fmt::format("{}", unit));
}

Result<double> depth_unit(const Bag& bag, std::string_view stream, const ImportOptions& options,
                          std::vector<std::string>& notes) {
  if (options.depth_unit_m) return *options.depth_unit_m;
  TURNSCAN_ASSIGN(const auto first, first_message(bag, std::string(stream) + std::string(kData)));
  TURNSCAN_ASSIGN(const auto image, rosbag::parse_image(first.bytes, first.wire));
  if (image.depth_units.value_or(0.0f) > 0.0f) return metres_of(*image.depth_units);
  const std::string sensor(stream.substr(0, stream.rfind('/')));
  for (const char* name : {"/option/Depth_Units/value", "/option/Depth Units/value"}) {
    const auto message = first_message(bag, sensor + name);
    if (!message) continue;
    TURNSCAN_ASSIGN(const float unit, rosbag::parse_float32(message->bytes, message->wire));
    return metres_of(unit);
  }
  notes.emplace_back("the file does not say the unit of depth; 1 mm a step, as the cameras come");
  return 1e-3;
}

Result<CameraIntrinsics> camera_of(const Bag& bag, std::string_view stream) {
  TURNSCAN_ASSIGN(const auto message,
                  first_message(bag, std::string(stream) + "/info/camera_info"));
  TURNSCAN_ASSIGN(const auto info, rosbag::parse_camera_info(message.bytes, message.wire));
  return ros_camera(info, false);
}

/// T_stream_reference and the reference's number, from the topic tf/REFERENCE: librealsense's
/// device::get_extrinsics() returns the transformation from the reference to the stream.
std::optional<std::pair<std::string, Pose>> place_of(const Bag& bag, std::string_view stream) {
  const std::string begin = std::string(stream) + "/tf/";
  for (const auto& connection : bag.connections()) {
    if (!connection.topic.starts_with(begin)) continue;
    const auto message = first_message(bag, connection.topic);
    if (!message) continue;
    const auto pose = rosbag::parse_transform(message->bytes, message->wire);
    if (pose) return std::pair(connection.topic.substr(begin.size()), *pose);
  }
  return std::nullopt;
}

void add_color(const Bag& bag, std::string_view depth, BagStreams& out) {
  const std::vector<std::string> streams = streams_of(bag, "Color_");
  if (streams.empty()) return;
  const std::string& stream = streams.front();
  const auto left_out = [&](std::string_view why) {
    out.notes.push_back(fmt::format("colour was left out: {}", why));
  };
  const std::string topic = stream + std::string(kData);
  const auto first = first_message(bag, topic);
  if (!first) return left_out(first.error().message);
  const auto image = rosbag::parse_image(first->bytes, first->wire);
  if (!image) return left_out(image.error().message);
  if (!is_color(image->encoding))
    return left_out(fmt::format("its encoding '{}' cannot be read", image->encoding.substr(0, 40)));
  const auto camera = camera_of(bag, stream);
  if (!camera) return left_out(camera.error().message);
  const auto from = place_of(bag, depth), to = place_of(bag, stream);
  if (!from || !to || from->first != to->first)
    return left_out("the file does not say where its camera is");
  out.sensor.color_intrinsics = *camera;
  out.sensor.T_color_sensor = to->second * from->second.inverse();
  out.color_topic = topic;
}

Result<std::string> chosen_stream(const Bag& bag, const ImportOptions& options) {
  const std::vector<std::string> streams = streams_of(bag, "Depth_");
  if (streams.empty())
    return fail_at(bag.path().string(), ErrorCode::kMissingData,
                   "the recording has no depth images; record with the depth stream on");
  if (options.topic.empty() && streams.size() == 1) return streams.front();
  const auto named = std::find_if(streams.begin(), streams.end(), [&](const std::string& stream) {
    return options.topic == stream || options.topic == stream + std::string(kData);
  });
  if (named != streams.end()) return *named;
  return fail_at(bag.path().string(), ErrorCode::kInvalidOption,
                 "{}; state one of its depth streams with --topic: {}",
                 options.topic.empty() ? "there are several cameras"
                                       : fmt::format("there is no depth in {}", options.topic),
                 fmt::join(streams, ", "));
}

}  // namespace

bool is_realsense(const Bag& bag) {
  return bag.find("/file_version") != nullptr || !streams_of(bag, "Depth_").empty();
}

Result<BagStreams> realsense_streams(const Bag& bag, const ImportOptions& options) {
  TURNSCAN_ASSIGN(const std::string stream, chosen_stream(bag, options));
  BagStreams out;
  const std::string name = device_fact(bag, stream, "Name");
  const std::string firmware = device_fact(bag, stream, "Firmware Version");
  out.origin = fmt::format("RealSense recording {}", display_name(bag.path()));
  if (!name.empty())
    out.notes.push_back(
        fmt::format("recorded by {}{}", name, firmware.empty() ? "" : ", firmware " + firmware));
  out.sensor.model = model_of(name);
  out.depth_topic = stream + std::string(kData);
  TURNSCAN_ASSIGN(out.sensor.depth_unit_m, depth_unit(bag, stream, options, out.notes));
  if (options.intrinsics.empty()) {
    TURNSCAN_ASSIGN(out.sensor.intrinsics, camera_of(bag, stream));
  } else {
    TURNSCAN_ASSIGN(out.sensor.intrinsics, stated_intrinsics(options));
  }
  add_color(bag, stream, out);
  return out;
}

}  // namespace turnscan::importers
