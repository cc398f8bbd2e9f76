#include <cmath>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/rosbag/ros_messages.hpp>

namespace turnscan::rosbag {

namespace {

constexpr std::size_t kMaxTransforms = 10000;

/// Reads fields sequentially. Beyond the end everything is zero, and good() is false.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T number() {
    const std::string_view bytes = take(sizeof(T));
    return bytes.size() == sizeof(T) ? file::load<T, false>(bytes.data()) : T();
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::int64_t time_ns() {
    const std::int64_t seconds = number<std::uint32_t>();
    return seconds * 1000000000 + number<std::uint32_t>();
  }
  Header header() {
    Header out;
    out.seq = number<std::uint32_t>();
    out.stamp_ns = time_ns();
    out.frame_id = text();
    return out;
  }
  template <std::size_t kCount>
  std::array<double, kCount> numbers() {
    std::array<double, kCount> out{};
    for (double& value : out) value = number<double>();
    return out;
  }
  std::size_t left() const { return rest_.size(); }
  bool good() const { return good_; }
  Result<> check(std::string_view what) const {
    if (good_) return {};
    return fail(ErrorCode::kFormat, "the message {} is shorter than it claims", what);
  }

 private:
  std::string_view take(std::size_t count) {
    good_ = good_ && count <= rest_.size();
    if (!good_) return {};
    const std::string_view out = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return out;
  }

  std::string_view rest_;
  bool good_ = true;
};

/// Translation, then the quaternion x y z w.
Result<Pose> pose_of(const std::array<double, 7>& v) {
  return pose_from(Vec3d(v[0], v[1], v[2]), v[3], v[4], v[5], v[6]);
}

}  // namespace

Result<Header> parse_header(std::string_view bytes) {
  Fields fields(bytes);
  const Header out = fields.header();
  TURNSCAN_TRY(fields.check("with a header"));
  return out;
}

Result<ImageMessage> parse_image(std::string_view bytes) {
  Fields fields(bytes);
  ImageMessage out;
  out.header = fields.header();
  out.height = fields.number<std::uint32_t>();
  out.width = fields.number<std::uint32_t>();
  out.encoding = fields.text();
  out.big_endian = fields.number<std::uint8_t>() != 0;
  out.step = fields.number<std::uint32_t>();
  out.data = fields.text();
  TURNSCAN_TRY(fields.check("sensor_msgs/Image"));
  if (out.header.frame_id == "1" && fields.left() == sizeof(float))
    out.depth_units = fields.number<float>();
  return out;
}

Result<CompressedImageMessage> parse_compressed_image(std::string_view bytes) {
  Fields fields(bytes);
  CompressedImageMessage out;
  out.header = fields.header();
  out.format = fields.text();
  out.data = fields.text();
  TURNSCAN_TRY(fields.check("sensor_msgs/CompressedImage"));
  return out;
}

Result<CameraInfoMessage> parse_camera_info(std::string_view bytes) {
  Fields fields(bytes);
  CameraInfoMessage out;
  out.header = fields.header();
  out.height = fields.number<std::uint32_t>();
  out.width = fields.number<std::uint32_t>();
  out.distortion_model = fields.text();
  const auto count = fields.number<std::uint32_t>();
  if (count > fields.left() / sizeof(double))
    return fail(ErrorCode::kFormat, "the message sensor_msgs/CameraInfo is shorter than it claims");
  for (std::uint32_t i = 0; i < count; ++i) out.d.push_back(fields.number<double>());
  out.k = fields.numbers<9>();
  (void)fields.numbers<9>();  // R
  out.p = fields.numbers<12>();
  TURNSCAN_TRY(fields.check("sensor_msgs/CameraInfo"));
  return out;
}

Result<KeyValue> parse_key_value(std::string_view bytes) {
  Fields fields(bytes);
  KeyValue out;
  out.key = fields.text();
  out.value = fields.text();
  TURNSCAN_TRY(fields.check("diagnostic_msgs/KeyValue"));
  return out;
}

Result<float> parse_float32(std::string_view bytes) {
  Fields fields(bytes);
  const auto out = fields.number<float>();
  TURNSCAN_TRY(fields.check("std_msgs/Float32"));
  return out;
}

Result<Pose> parse_transform(std::string_view bytes) {
  Fields fields(bytes);
  const auto values = fields.numbers<7>();
  TURNSCAN_TRY(fields.check("geometry_msgs/Transform"));
  return pose_of(values);
}

Result<std::vector<TransformStamped>> parse_transforms(std::string_view bytes) {
  Fields fields(bytes);
  const auto count = fields.number<std::uint32_t>();
  std::vector<TransformStamped> out;
  for (std::uint32_t i = 0; i < count && fields.good() && i < kMaxTransforms; ++i) {
    TransformStamped transform;
    transform.parent = std::string(fields.header().frame_id);
    transform.child = std::string(fields.text());
    const auto pose = pose_of(fields.numbers<7>());
    if (!fields.good() || !pose) continue;
    transform.T_parent_child = *pose;
    out.push_back(std::move(transform));
  }
  TURNSCAN_TRY(fields.check("tf2_msgs/TFMessage"));
  return out;
}

}  // namespace turnscan::rosbag
