#include <cmath>
#include <turnscan/io/rosbag/ros_messages.hpp>
#include <turnscan/io/rosbag/wire_fields.hpp>

namespace turnscan::rosbag {

namespace {

constexpr std::size_t kMaxTransforms = 10000;

std::int64_t time_of(WireFields& fields) {
  const std::int64_t seconds = fields.number<std::uint32_t>();
  return seconds * 1000000000 + fields.number<std::uint32_t>();
}

/// ROS 2 has no number of the frame.
Header header_of(WireFields& fields) {
  Header out;
  if (!fields.cdr()) out.seq = fields.number<std::uint32_t>();
  out.stamp_ns = time_of(fields);
  out.frame_id = fields.text();
  return out;
}

template <std::size_t kCount>
std::array<double, kCount> numbers_of(WireFields& fields) {
  std::array<double, kCount> out{};
  for (double& value : out) value = fields.number<double>();
  return out;
}

/// Translation, then the quaternion x y z w.
Result<Pose> pose_of(const std::array<double, 7>& v) {
  return pose_from(Vec3d(v[0], v[1], v[2]), v[3], v[4], v[5], v[6]);
}

}  // namespace

Result<Header> parse_header(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  const Header out = header_of(fields);
  TURNSCAN_TRY(fields.check("with a header"));
  return out;
}

Result<ImageMessage> parse_image(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  ImageMessage out;
  out.header = header_of(fields);
  out.height = fields.number<std::uint32_t>();
  out.width = fields.number<std::uint32_t>();
  out.encoding = fields.text();
  out.big_endian = fields.number<std::uint8_t>() != 0;
  out.step = fields.number<std::uint32_t>();
  out.data = fields.data();
  TURNSCAN_TRY(fields.check("sensor_msgs/Image"));
  if (out.header.frame_id == "1" && fields.left() == sizeof(float))
    out.depth_units = fields.number<float>();
  return out;
}

Result<CompressedImageMessage> parse_compressed_image(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  CompressedImageMessage out;
  out.header = header_of(fields);
  out.format = fields.text();
  out.data = fields.data();
  TURNSCAN_TRY(fields.check("sensor_msgs/CompressedImage"));
  return out;
}

Result<CameraInfoMessage> parse_camera_info(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  CameraInfoMessage out;
  out.header = header_of(fields);
  out.height = fields.number<std::uint32_t>();
  out.width = fields.number<std::uint32_t>();
  out.distortion_model = fields.text();
  const auto count = fields.number<std::uint32_t>();
  if (count > fields.left() / sizeof(double))
    return fail(ErrorCode::kFormat, "the message sensor_msgs/CameraInfo is shorter than it claims");
  for (std::uint32_t i = 0; i < count; ++i) out.d.push_back(fields.number<double>());
  out.k = numbers_of<9>(fields);
  (void)numbers_of<9>(fields);  // R
  out.p = numbers_of<12>(fields);
  TURNSCAN_TRY(fields.check("sensor_msgs/CameraInfo"));
  return out;
}

Result<KeyValue> parse_key_value(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  KeyValue out;
  out.key = fields.text();
  out.value = fields.text();
  TURNSCAN_TRY(fields.check("diagnostic_msgs/KeyValue"));
  return out;
}

Result<float> parse_float32(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  const auto out = fields.number<float>();
  TURNSCAN_TRY(fields.check("std_msgs/Float32"));
  return out;
}

Result<Pose> parse_transform(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  const auto values = numbers_of<7>(fields);
  TURNSCAN_TRY(fields.check("geometry_msgs/Transform"));
  return pose_of(values);
}

Result<std::vector<TransformStamped>> parse_transforms(std::string_view bytes, Wire wire) {
  WireFields fields(bytes, wire);
  const auto count = fields.number<std::uint32_t>();
  std::vector<TransformStamped> out;
  for (std::uint32_t i = 0; i < count && fields.good() && i < kMaxTransforms; ++i) {
    TransformStamped transform;
    transform.parent = std::string(header_of(fields).frame_id);
    transform.child = std::string(fields.text());
    const auto pose = pose_of(numbers_of<7>(fields));
    if (!fields.good() || !pose) continue;
    transform.T_parent_child = *pose;
    out.push_back(std::move(transform));
  }
  TURNSCAN_TRY(fields.check("tf2_msgs/TFMessage"));
  return out;
}

}  // namespace turnscan::rosbag
