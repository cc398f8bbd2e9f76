#include "tests/support/rosbag/ros_bag.hpp"

#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float32.h>

#include <cmath>
#include <cstring>

namespace turnscan::testing {

/// A message of which only the bytes are known here.
struct RawMessage {
  std::string type, bytes;
};

}  // namespace turnscan::testing

namespace ros {
using turnscan::testing::RawMessage;
namespace message_traits {
template <>
struct IsMessage<RawMessage> : TrueType {};
template <>
struct MD5Sum<RawMessage> {
  static const char* value(const RawMessage&) { return "0123456789abcdef0123456789abcdef"; }
};
template <>
struct DataType<RawMessage> {
  static const char* value(const RawMessage& m) { return m.type.c_str(); }
};
template <>
struct Definition<RawMessage> {
  static const char* value(const RawMessage&) { return "uint8[] bytes\n"; }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<RawMessage> {
  template <class Stream>
  static void write(Stream& stream, const RawMessage& m) {
    std::memcpy(stream.advance(std::uint32_t(m.bytes.size())), m.bytes.data(), m.bytes.size());
  }
  static std::uint32_t serializedLength(const RawMessage& m) {
    return std::uint32_t(m.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace turnscan::testing {

namespace {

const ros::Time kAtOnce(0, 1);  // when librealsense records what does not change

/// The bytes of a message of ROS's.
template <class Message>
std::string bytes_of(const Message& message) {
  std::string out(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(out.data()),
                                     std::uint32_t(out.size()));
  ros::serialization::serialize(stream, message);
  return out;
}

ros::Time time_of(double seconds) {
  const double whole = std::floor(seconds);
  return {std::uint32_t(whole), std::uint32_t(std::lround((seconds - whole) * 1e9))};
}

geometry_msgs::Transform transform_of(const BagPose& pose) {
  geometry_msgs::Transform out;
  out.translation.x = pose[0];
  out.translation.y = pose[1];
  out.translation.z = pose[2];
  out.rotation.x = pose[3];
  out.rotation.y = pose[4];
  out.rotation.z = pose[5];
  out.rotation.w = pose[6];
  return out;
}

void put_header(const BagImage& image, std_msgs::Header& header) {
  header.seq = image.seq;
  header.stamp = time_of(image.stamp_s);
  header.frame_id = image.depth_units != 0.0f ? "1" : image.frame_id;
}

}  // namespace

struct ReferenceBag::State {
  rosbag::Bag bag;
};

ReferenceBag::ReferenceBag(const std::string& path, BagPacking packing, std::uint32_t chunk_bytes)
    : state_(std::make_unique<State>()) {
  state_->bag.open(path, rosbag::bagmode::Write);
  if (packing == BagPacking::kBz2) state_->bag.setCompression(rosbag::compression::BZ2);
  if (packing == BagPacking::kLz4) state_->bag.setCompression(rosbag::compression::LZ4);
  state_->bag.setChunkThreshold(chunk_bytes);
}

ReferenceBag::~ReferenceBag() { state_->bag.close(); }

void ReferenceBag::image(const std::string& topic, const BagImage& image) {
  sensor_msgs::Image message;
  put_header(image, message.header);
  message.width = std::uint32_t(image.width);
  message.height = std::uint32_t(image.height);
  message.step = std::uint32_t(image.row_bytes);
  message.encoding = image.encoding;
  message.data.assign(image.pixels.begin(), image.pixels.end());
  const ros::Time recorded = time_of(image.recorded_s);
  if (image.depth_units == 0.0f) return state_->bag.write(topic, recorded, message);
  std::string bytes = bytes_of(message);
  bytes.append(reinterpret_cast<const char*>(&image.depth_units), sizeof(float));
  state_->bag.write(topic, recorded, RawMessage{"sensor_msgs/Image", bytes});
}

void ReferenceBag::compressed(const std::string& topic, const BagImage& image,
                              const std::string& format) {
  sensor_msgs::CompressedImage message;
  put_header(image, message.header);
  message.format = format;
  message.data.assign(image.pixels.begin(), image.pixels.end());
  state_->bag.write(topic, time_of(image.recorded_s), message);
}

void ReferenceBag::camera(const std::string& topic, const BagCamera& camera,
                          const std::string& model, const std::string& frame_id) {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = frame_id;
  info.width = std::uint32_t(camera.width);
  info.height = std::uint32_t(camera.height);
  info.distortion_model = model;
  info.D.assign(camera.distortion.begin(), camera.distortion.end());
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  state_->bag.write(topic, kAtOnce, info);
}

void ReferenceBag::number(const std::string& topic, float value) {
  std_msgs::Float32 message;
  message.data = value;
  state_->bag.write(topic, kAtOnce, message);
}

void ReferenceBag::key_value(const std::string& topic, const std::string& key,
                             const std::string& value) {
  state_->bag.write(topic, kAtOnce,
                    RawMessage{"diagnostic_msgs/KeyValue", bytes_of(key) + bytes_of(value)});
}

void ReferenceBag::transform(const std::string& topic, const BagPose& pose) {
  state_->bag.write(topic, kAtOnce, transform_of(pose));
}

void ReferenceBag::frames(const std::string& topic, const std::string& parent,
                          const std::string& child, const BagPose& T_parent_child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform = transform_of(T_parent_child);
  const std::vector<geometry_msgs::TransformStamped> list{transform};
  state_->bag.write(topic, kAtOnce, RawMessage{"tf2_msgs/TFMessage", bytes_of(list)});
}

}  // namespace turnscan::testing
