#include <algorithm>
#include <map>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/import_ros/ros_camera.hpp>
#include <turnscan/io/import_ros/ros_images.hpp>
#include <turnscan/io/import_ros/rosbag_streams.hpp>

namespace turnscan::importers {

namespace {

using rosbag::Bag;

constexpr double kMillimetre = 1e-3;
constexpr double kFloatStep = 1e-4;  // the step to which live floating-point depth is rounded
constexpr int kMaxLinks = 64;        // in a chain of frames

/// A topic of images, as described by its first message.
struct ImageTopic {
  std::string topic;
  bool compressed = false;
  std::string encoding;
  std::string frame_id;
  std::uint32_t width = 0, height = 0;  ///< 0: not known until it is unpacked
};

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

std::optional<ImageTopic> look_at(const Bag& bag, const rosbag::Connection& connection) {
  const bool compressed = connection.type == "sensor_msgs/CompressedImage";
  if (!compressed && connection.type != "sensor_msgs/Image") return std::nullopt;
  if (connection.wire() == rosbag::Wire::kOther) return std::nullopt;
  const auto message = first_message(bag, connection.topic);
  if (!message) return std::nullopt;
  ImageTopic out;
  out.topic = connection.topic;
  out.compressed = compressed;
  if (compressed) {
    const auto image = rosbag::parse_compressed_image(message->bytes, message->wire);
    if (!image) return std::nullopt;
    const std::string_view depth = compressed_depth_encoding(image->format);
    out.encoding = depth.empty() ? "jpeg or png" : std::string(depth);
    out.frame_id = std::string(image->header.frame_id);
    return out;
  }
  const auto image = rosbag::parse_image(message->bytes, message->wire);
  if (!image) return std::nullopt;
  out.encoding = file::clean_name(image->encoding.substr(0, 40));
  out.frame_id = std::string(image->header.frame_id);
  out.width = image->width;
  out.height = image->height;
  return out;
}

std::vector<ImageTopic> image_topics(const Bag& bag) {
  std::map<std::string, ImageTopic> topics;
  for (const auto& connection : bag.connections()) {
    if (topics.count(connection.topic) > 0 || !bag.budget().state()) continue;
    if (auto topic = look_at(bag, connection)) topics.emplace(connection.topic, std::move(*topic));
  }
  std::vector<ImageTopic> out;
  for (auto& [name, topic] : topics) out.push_back(std::move(topic));
  return out;
}

bool holds_depth(const ImageTopic& topic) {
  return is_integer_depth(topic.encoding) || is_float_depth(topic.encoding);
}

/// 16 bits are depth or infrared intensity: then the name decides.
bool looks_like_depth(const ImageTopic& topic) {
  if (!holds_depth(topic)) return false;
  if (contains(topic.topic, "depth")) return true;
  const bool infrared = contains(topic.topic, "infra") || contains(topic.topic, "/ir");
  return topic.encoding != "mono16" && !infrared;
}

std::string list_of(const std::vector<ImageTopic>& topics) {
  std::string text;
  for (const ImageTopic& topic : topics)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", topic.topic, topic.encoding);
  return text.empty() ? "none" : text;
}

Result<ImageTopic> chosen_depth(const Bag& bag, const std::vector<ImageTopic>& topics,
                                const std::string& stated) {
  const std::string path = bag.path().string();
  std::vector<ImageTopic> depths;
  for (const ImageTopic& topic : topics) {
    if (topic.topic == stated && holds_depth(topic)) return topic;
    if (looks_like_depth(topic)) depths.push_back(topic);
  }
  if (!stated.empty())
    return fail_at(path, ErrorCode::kInvalidOption,
                   "the topic {} holds no depth images; state another with --topic. Those with "
                   "images are: {}",
                   stated, list_of(topics));
  if (depths.size() == 1) return depths.front();
  if (depths.empty())
    return fail_at(path, ErrorCode::kMissingData,
                   "no topic is recognised as depth images (16UC1, 32FC1); state one with --topic. "
                   "Those with images are: {}",
                   list_of(topics));
  return fail_at(path, ErrorCode::kInvalidOption,
                 "several topics hold depth images; state one with --topic: {}", list_of(depths));
}

/// "/camera/depth" of "/camera/depth/image_raw" and "/camera/depth/image_raw/compressedDepth".
std::string camera_of_topic(const ImageTopic& topic) {
  std::string name = topic.topic;
  if (topic.compressed) name = name.substr(0, name.rfind('/'));
  return name.substr(0, name.rfind('/'));
}

Result<CameraIntrinsics> camera_of(const Bag& bag, const ImageTopic& topic) {
  const std::string name = camera_of_topic(topic) + "/camera_info";
  TURNSCAN_ASSIGN(const auto message, first_message(bag, name));
  TURNSCAN_ASSIGN(const auto info, rosbag::parse_camera_info(message.bytes, message.wire));
  return ros_camera(info, contains(topic.topic, "rect") || contains(topic.topic, "registered"));
}

Result<CameraIntrinsics> depth_camera(const Bag& bag, const ImageTopic& topic,
                                      const ImportOptions& options) {
  if (!options.intrinsics.empty()) {
    TURNSCAN_ASSIGN(CameraIntrinsics camera, stated_intrinsics(options));
    camera.width = int(std::min<std::uint32_t>(topic.width, 65535));
    camera.height = int(std::min<std::uint32_t>(topic.height, 65535));
    return camera;
  }
  auto camera = camera_of(bag, topic);
  if (camera || camera.error().code != ErrorCode::kMissingData) return camera;
  return fail_at(bag.path().string(), ErrorCode::kMissingData,
                 "there is no {}/camera_info with the camera of {}; state it: --intrinsics "
                 "fx,fy,cx,cy",
                 camera_of_topic(topic), topic.topic);
}

/// The coordinate frames: parent of each, and the pose in it.
std::map<std::string, rosbag::TransformStamped> transforms_of(const Bag& bag) {
  std::map<std::string, rosbag::TransformStamped> out;
  for (const char* topic : {"/tf_static", "tf_static", "/tf", "tf"}) {
    constexpr std::size_t kMaxMessages = 1000;  // moving frames are not needed
    const auto places = bag.messages(topic);
    for (std::size_t i = 0; i < std::min(places.size(), kMaxMessages); ++i) {
      const auto message = bag.read(places[i]);
      if (!message) continue;
      const auto transforms = rosbag::parse_transforms(message->bytes, message->wire);
      if (!transforms) continue;
      for (const auto& transform : *transforms) out.emplace(transform.child, transform);
    }
  }
  return out;
}

/// The transformation from `from` to `to`, if a chain of frames connects them.
std::optional<Pose> T_between(const std::map<std::string, rosbag::TransformStamped>& transforms,
                              const std::string& to, const std::string& from) {
  // From each frame up to its root.
  const auto chain = [&](std::string frame) {
    std::map<std::string, Pose> out{{frame, Pose::Identity()}};
    Pose T = Pose::Identity();
    for (int i = 0; i < kMaxLinks; ++i) {
      const auto up = transforms.find(frame);
      if (up == transforms.end()) break;
      T = up->second.T_parent_child * T;
      frame = up->second.parent;
      if (!out.emplace(frame, T).second) break;
    }
    return out;
  };
  const auto of_from = chain(from), of_to = chain(to);
  for (const auto& [frame, T_frame_from] : of_from) {
    const auto common = of_to.find(frame);
    if (common != of_to.end()) return Pose(common->second.inverse() * T_frame_from);
  }
  return std::nullopt;
}

/// Uses the topic as colour, or returns the reason why not.
std::string take_color(const Bag& bag, const ImageTopic& depth, const ImageTopic& color,
                       const std::map<std::string, rosbag::TransformStamped>& transforms,
                       BagStreams& out) {
  const auto camera = camera_of(bag, color);
  const bool same_frame = !depth.frame_id.empty() && depth.frame_id == color.frame_id;
  if (!camera && !same_frame) return camera.error().message;
  const CameraIntrinsics& own = out.sensor.intrinsics;
  const bool same_size = camera ? camera->width == own.width && camera->height == own.height
                                : int(color.width) == own.width && int(color.height) == own.height;
  if (!same_frame || !same_size) {
    if (!camera) return camera.error().message;
    const auto T = same_frame ? std::optional<Pose>(Pose::Identity())
                              : T_between(transforms, color.frame_id, depth.frame_id);
    if (!T)
      return fmt::format("no transform joins its frame {} with {}", color.frame_id, depth.frame_id);
    out.sensor.color_intrinsics = *camera;
    out.sensor.T_color_sensor = *T;
  }
  out.color_topic = color.topic;
  out.color_compressed = color.compressed;
  return {};
}

/// The first usable topic of colour images; those registered to depth come first.
void add_color(const Bag& bag, const ImageTopic& depth, const std::vector<ImageTopic>& topics,
               BagStreams& out) {
  std::vector<ImageTopic> colors;
  for (const ImageTopic& topic : topics) {
    const bool grey = topic.encoding == "mono8" || topic.encoding == "8UC1";
    const bool colored =
        topic.compressed ? topic.encoding == "jpeg or png" : is_color(topic.encoding) && !grey;
    const bool infrared = contains(topic.topic, "infra") || contains(topic.topic, "/ir/");
    if (colored && !infrared) colors.push_back(topic);
  }
  std::stable_sort(colors.begin(), colors.end(), [&](const ImageTopic& a, const ImageTopic& b) {
    return (a.frame_id == depth.frame_id) > (b.frame_id == depth.frame_id);
  });
  const auto transforms = colors.empty() ? decltype(transforms_of(bag))() : transforms_of(bag);
  for (const ImageTopic& color : colors) {
    const std::string why = take_color(bag, depth, color, transforms, out);
    if (why.empty()) {
      out.notes.push_back(fmt::format("colour from {}", color.topic));
      return;
    }
    out.notes.push_back(fmt::format("colour of {} was left out: {}", color.topic, why));
  }
}

}  // namespace

Result<rosbag::Payload> first_message(const Bag& bag, std::string_view topic) {
  const auto place = bag.first(topic);
  if (!place)
    return fail_at(bag.path().string(), ErrorCode::kMissingData, "the bag has no message of {}",
                   topic);
  return bag.read(*place);
}

Result<BagStreams> ros_streams(const Bag& bag, const ImportOptions& options) {
  const std::vector<ImageTopic> topics = image_topics(bag);
  TURNSCAN_TRY(bag.budget().state());
  TURNSCAN_ASSIGN(const ImageTopic depth, chosen_depth(bag, topics, options.topic));
  BagStreams out;
  out.origin = fmt::format("ROS bag {}", display_name(bag.path()));
  out.notes.push_back(fmt::format("depth from {}", depth.topic));
  out.depth_topic = depth.topic;
  out.depth_compressed = depth.compressed;
  const bool floating = is_float_depth(depth.encoding);
  out.sensor.depth_unit_m = options.depth_unit_m.value_or(floating ? kFloatStep : kMillimetre);
  if (!options.depth_unit_m)
    out.notes.emplace_back(floating ? "depth in metres was rounded to 0.1 mm"
                                    : "depth images of 16 bits are in millimetres (REP 118)");
  TURNSCAN_ASSIGN(out.sensor.intrinsics, depth_camera(bag, depth, options));
  add_color(bag, depth, topics, out);
  return out;
}

}  // namespace turnscan::importers
