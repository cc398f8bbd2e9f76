#include "tests/support/rosbag/reference_bag.hpp"

#include <limits>

namespace turnscan::testing {

BagCamera bag_camera(const CameraIntrinsics& camera) {
  BagCamera out{camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, {}};
  for (std::size_t i = 0; i < out.distortion.size(); ++i) out.distortion[i] = camera.distortion[i];
  return out;
}

BagPose bag_pose(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Vec3d& t = pose.translation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

BagImage depth_image(const DepthImage& depth, const std::string& encoding, double time_s,
                     std::uint32_t seq) {
  BagImage out;
  out.seq = seq;
  out.stamp_s = out.recorded_s = time_s;
  out.encoding = encoding;
  out.width = depth.width;
  out.height = depth.height;
  out.row_bytes = 2 * depth.width;
  out.pixels.assign(reinterpret_cast<const char*>(depth.pixels.data()), 2 * depth.pixels.size());
  return out;
}

BagImage float_image(const DepthImage& depth, double unit_m, double time_s, std::uint32_t seq) {
  std::vector<float> metres;
  for (const std::uint16_t value : depth.pixels)
    metres.push_back(value == kNoReturn ? std::numeric_limits<float>::quiet_NaN()
                                        : float(value * unit_m));
  BagImage out = depth_image(depth, "32FC1", time_s, seq);
  out.row_bytes *= 2;
  out.pixels.assign(reinterpret_cast<const char*>(metres.data()), 4 * metres.size());
  return out;
}

BagImage color_image(const ColorImage& color, double time_s, std::uint32_t seq) {
  BagImage out;
  out.seq = seq;
  out.stamp_s = out.recorded_s = time_s;
  out.encoding = "rgb8";
  out.width = color.width;
  out.height = color.height;
  out.row_bytes = 3 * color.width;
  for (const Rgb& pixel : color.pixels) out.pixels += {char(pixel.r), char(pixel.g), char(pixel.b)};
  return out;
}

void put_realsense_facts(ReferenceBag& bag, const SensorInfo& sensor, const std::string& name) {
  const std::string depth = "/device_0/sensor_0", color = "/device_0/sensor_1";
  bag.number("/file_version", 0.0f);
  bag.key_value("/device_0/info", "Name", name);
  bag.key_value("/device_0/info", "Serial Number", "1");
  bag.number(depth + "/option/Depth_Units/value", float(sensor.depth_unit_m));
  bag.camera(depth + "/Depth_0/info/camera_info", bag_camera(sensor.intrinsics), "Brown Conrady");
  bag.transform(depth + "/Depth_0/tf/0", bag_pose(Pose::Identity()));
  if (!sensor.color_intrinsics) return;
  bag.camera(color + "/Color_0/info/camera_info", bag_camera(*sensor.color_intrinsics),
             "Brown Conrady");
  bag.transform(color + "/Color_0/tf/0", bag_pose(sensor.T_color_sensor));
}

void put_realsense(ReferenceBag& bag, const FrameSequence& frames, const std::string& name,
                   double first_stamp_s) {
  const SensorInfo& sensor = frames.header().sensors.front();
  put_realsense_facts(bag, sensor, name);
  const double first_s = frames.frames().front().time_s;
  for (std::size_t i = 0; i < frames.frames().size(); ++i) {
    const FrameInfo& info = frames.frames()[i];
    if (info.status == FrameStatus::kDropped) continue;
    const auto frame = frames.read(i);
    BagImage image = depth_image(frame.value().depth, "mono16",
                                 first_stamp_s + info.time_s - first_s, info.index + 100);
    image.recorded_s = info.time_s - first_s + 0.01;
    bag.image("/device_0/sensor_0/Depth_0/image/data", image);
    bag.key_value("/device_0/sensor_0/Depth_0/image/metadata", "Actual Exposure", "8500");
    if (frame->color.empty() || !sensor.color_intrinsics) continue;
    BagImage color = color_image(frame->color, image.stamp_s + 0.002, info.index + 90);
    color.recorded_s = image.recorded_s + 0.004;
    bag.image("/device_0/sensor_1/Color_0/image/data", color);
  }
}

}  // namespace turnscan::testing
