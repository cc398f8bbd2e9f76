// Bags that ROS's own library wrote, imported.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <turnscan/io/file/atomic_file.hpp>

#include "tests/io/import/foreign_data.hpp"
#include "tests/support/memory_sequence.hpp"
#include "tests/support/rosbag/reference_bag.hpp"

namespace turnscan {
namespace {

using namespace testing;

constexpr const char* kDepthTopic = "/device_0/sensor_0/Depth_0/image/data";

CameraIntrinsics camera_of_size(int width, int height) {
  CameraIntrinsics camera;
  camera.width = width;
  camera.height = height;
  camera.fx = 40.25;
  camera.fy = 40.5;
  camera.cx = width / 2.0 - 0.3;
  camera.cy = height / 2.0 + 0.4;
  return camera;
}

/// Noise, so that no two frames or pixels are alike, 0 and 65535 among it.
DepthImage noisy_depth(int width, int height, unsigned seed) {
  DepthImage out(width, height);
  for (std::uint16_t& pixel : out.pixels) {
    seed = seed * 1664525U + 1013904223U;
    pixel = std::uint16_t(seed >> 16);
  }
  out.pixels[3] = 0;
  out.pixels[4] = 65535;
  return out;
}

ColorImage noisy_color(int width, int height, unsigned seed) {
  ColorImage out(width, height);
  for (Rgb& pixel : out.pixels) {
    seed = seed * 1664525U + 1013904223U;
    pixel = {std::uint8_t(seed >> 8), std::uint8_t(seed >> 16), std::uint8_t(seed >> 24)};
  }
  return out;
}

/// Eight frames of a camera with colour of its own; the fourth and the fifth were lost.
MemorySequence sample() {
  MemorySequence out;
  SensorInfo sensor;
  sensor.intrinsics = camera_of_size(32, 24);
  sensor.depth_unit_m = 1e-4;
  sensor.color_intrinsics = camera_of_size(20, 10);
  sensor.color_intrinsics->distortion[0] = 0.02;
  sensor.T_color_sensor.translation() = Vec3d(0.0148, -0.0003, 0.0005);
  sensor.T_color_sensor.linear() =
      Eigen::AngleAxisd(0.02, Vec3d(1, 2, 3).normalized()).toRotationMatrix();
  out.header_value.sensors.push_back(sensor);
  for (unsigned i = 0; i < 8; ++i) {
    Frame frame;
    frame.info.index = i;
    frame.info.time_s = i / 30.0 + (i == 6 ? 0.001 : 0.0);
    frame.info.status = i == 3 || i == 4 ? FrameStatus::kDropped : FrameStatus::kOk;
    frame.depth = noisy_depth(32, 24, i);
    frame.color = noisy_color(20, 10, i);
    out.add(std::move(frame));
  }
  return out;
}

DepthImage without_65535(DepthImage image) {
  std::replace(image.pixels.begin(), image.pixels.end(), kOutsideCrop, kNoReturn);
  return image;
}

void expect_same(const FrameSequence& got, const MemorySequence& wanted) {
  ASSERT_EQ(got.frames().size(), wanted.frames().size());
  for (std::size_t i = 0; i < got.frames().size(); ++i) {
    const FrameInfo& info = got.frames()[i];
    EXPECT_EQ(info.index, i);
    EXPECT_EQ(info.status, wanted.frames()[i].status);
    if (info.status == FrameStatus::kDropped) {
      EXPECT_FALSE(got.read(i));
      continue;
    }
    EXPECT_NEAR(info.time_s, wanted.frames()[i].time_s, 1.1e-9);
    const Frame frame = frame_of(got, i);
    EXPECT_EQ(frame.depth.pixels, without_65535(wanted.data[i].depth).pixels);
    EXPECT_EQ(frame.color.pixels, wanted.data[i].color.pixels);
  }
}

class RealSense : public ::testing::TestWithParam<BagPacking> {};
INSTANTIATE_TEST_SUITE_P(Packings, RealSense,
                         ::testing::Values(BagPacking::kNone, BagPacking::kBz2, BagPacking::kLz4));

TEST_P(RealSense, IsWhatWasRecorded) {
  const TempFolder folder;
  const MemorySequence wanted = sample();
  {
    ReferenceBag bag((folder / "take.bag").string(), GetParam(), 4000);  // several chunks
    put_realsense(bag, wanted, "Intel RealSense D435I", 360.815359);
  }
  const auto got = open(folder / "take.bag");
  expect_same(*got, wanted);
  const SensorInfo &sensor = got->header().sensors.at(0), &from = wanted.header().sensors[0];
  EXPECT_EQ(sensor.model, "realsense-d435");
  EXPECT_EQ(sensor.depth_unit_m, 1e-4);
  EXPECT_EQ(sensor.intrinsics.fx, from.intrinsics.fx);
  EXPECT_EQ(sensor.intrinsics.cy, from.intrinsics.cy);
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_EQ(sensor.color_intrinsics->distortion, from.color_intrinsics->distortion);
  EXPECT_TRUE(sensor.T_color_sensor.isApprox(from.T_color_sensor, 1e-12));
  EXPECT_EQ(got->header().source.find("not closed"), std::string::npos);
}

TEST_P(RealSense, CutOffOpensAsFarAsItIsWhole) {
  const TempFolder folder;
  const MemorySequence wanted = sample();
  {
    ReferenceBag bag((folder / "take.bag").string(), GetParam(), 4000);
    put_realsense(bag, wanted, "Intel RealSense D455", 12.0);
  }
  const std::string bytes = read_file(folder / "take.bag").value();
  std::size_t most = 0;
  for (int k = 0; k <= 50; ++k) {
    std::ofstream(folder / "cut.bag", std::ios::binary)
        << bytes.substr(0, bytes.size() * std::size_t(k) / 50);
    const auto got = open_foreign(folder / "cut.bag", {});
    if (!got) {
      EXPECT_EQ(most, 0u) << k;
      continue;
    }
    std::size_t frames = 0;
    for (std::size_t i = 0; i < (*got)->frames().size(); ++i) {
      if ((*got)->frames()[i].status == FrameStatus::kDropped) continue;
      const auto frame = (*got)->read(i);
      if (frame && frame->depth.pixels == without_65535(wanted.data[i].depth).pixels) ++frames;
    }
    EXPECT_GE(frames, most) << k;
    most = frames;
    if (k < 30) {
      EXPECT_NE((*got)->header().source.find("was not closed"), std::string::npos) << k;
    }
  }
  EXPECT_EQ(most, 6u);
}

TEST_P(RealSense, WithFlippedBitsIsRefusedOrReadWithoutHarm) {
  const TempFolder folder;
  {
    ReferenceBag bag((folder / "take.bag").string(), GetParam(), 4000);
    put_realsense(bag, sample(), "Intel RealSense D405", 12.0);
  }
  const std::string whole = read_file(folder / "take.bag").value();
  for (std::size_t k = 0; k < 150; ++k) {
    std::string bytes = whole;
    bytes[k * 7919 % bytes.size()] ^= char(1U << (k % 8));
    std::ofstream(folder / "bad.bag", std::ios::binary) << bytes;
    const auto got = open_foreign(folder / "bad.bag", {});
    if (!got) {
      EXPECT_EQ(got.error().text().find('\n'), std::string::npos);
      continue;
    }
    for (std::size_t i = 0; i < (*got)->frames().size(); i += 3) (void)(*got)->read(i);
  }
}

TEST(RealSenseBag, TakesTheUnitThatEachImageSays) {
  const TempFolder folder;
  {
    ReferenceBag bag((folder / "take.bag").string());
    SensorInfo sensor = sample().header().sensors[0];
    sensor.color_intrinsics.reset();
    put_realsense_facts(bag, sensor, "Intel RealSense D405");
    BagImage image = depth_image(noisy_depth(32, 24, 1), "mono16", 5.0, 7);
    image.depth_units = 1e-5f;
    bag.image(kDepthTopic, image);
  }
  const auto got = open(folder / "take.bag");
  EXPECT_EQ(got->header().sensors[0].depth_unit_m, 1e-5);
  EXPECT_EQ(got->header().sensors[0].model, "realsense-d405");
}

TEST(RealSenseBag, TurnsTheLensOfItsColourCameraRound) {
  const TempFolder folder;
  CameraIntrinsics inverse = camera_of_size(64, 48);
  inverse.distortion = {-0.055, 0.064, 0.0003, 0.0006, -0.02};
  SensorInfo sensor = sample().header().sensors[0];
  {
    ReferenceBag bag((folder / "take.bag").string());
    sensor.color_intrinsics.reset();
    put_realsense_facts(bag, sensor, "Intel RealSense D455");
    bag.camera("/device_0/sensor_1/Color_0/info/camera_info", bag_camera(inverse),
               "Inverse Brown Conrady");
    bag.transform("/device_0/sensor_1/Color_0/tf/0", bag_pose(Pose::Identity()));
    bag.image(kDepthTopic, depth_image(noisy_depth(32, 24, 1), "mono16", 5.0, 7));
    bag.image("/device_0/sensor_1/Color_0/image/data", color_image(noisy_color(64, 48, 2), 5, 7));
  }
  const auto got = open(folder / "take.bag");
  ASSERT_TRUE(got->header().sensors[0].color_intrinsics);
  const CameraIntrinsics& camera = *got->header().sensors[0].color_intrinsics;
  for (const double u : {0.0, 20.0, 63.0}) {
    for (const double v : {0.0, 30.0, 47.0}) {
      // librealsense's rsutil.h, rs2_deproject_pixel_to_point
      const double x = (u - inverse.cx) / inverse.fx, y = (v - inverse.cy) / inverse.fy;
      const auto& c = inverse.distortion;
      const double r2 = x * x + y * y, f = 1 + c[0] * r2 + c[1] * r2 * r2 + c[4] * r2 * r2 * r2;
      const Vec3d ray(x * f + 2 * c[2] * x * y + c[3] * (r2 + 2 * x * x),
                      y * f + 2 * c[3] * x * y + c[2] * (r2 + 2 * y * y), 1.0);
      EXPECT_LT((camera.project(ray) - Eigen::Vector2d(u, v)).norm(), 0.3) << u << ", " << v;
    }
  }
}

TEST(RosBag, TakesMillimetresAndMetres) {
  for (const bool floating : {false, true}) {
    const TempFolder folder;
    const double unit_m = floating ? 1e-4 : 1e-3;
    {
      ReferenceBag bag((folder / "a.bag").string(), BagPacking::kLz4);
      bag.camera("/camera/depth/camera_info", bag_camera(camera_of_size(32, 24)), "plumb_bob");
      for (unsigned i = 0; i < 3; ++i) {
        const DepthImage depth = noisy_depth(32, 24, i);
        bag.image("/camera/depth/image_raw", floating ? float_image(depth, unit_m, 9 + i, i)
                                                      : depth_image(depth, "16UC1", 9 + i, i));
      }
    }
    const auto got = open(folder / "a.bag");
    EXPECT_EQ(got->header().sensors[0].depth_unit_m, unit_m);
    ASSERT_EQ(got->frames().size(), 3u);
    EXPECT_EQ(got->frames()[2].time_s, 2.0);
    EXPECT_EQ(frame_of(*got, 1).depth.pixels, without_65535(noisy_depth(32, 24, 1)).pixels);
  }
}

TEST(RosBag, AsksWhichOfSeveralTopicsIsMeant) {
  const TempFolder folder;
  {
    ReferenceBag bag((folder / "a.bag").string());
    for (const char* name : {"/camera/depth", "/camera/aligned_depth_to_color"}) {
      bag.camera(std::string(name) + "/camera_info", bag_camera(camera_of_size(32, 24)),
                 "plumb_bob");
      bag.image(std::string(name) + "/image_raw",
                depth_image(noisy_depth(32, 24, 1), "16UC1", 3.0, 1));
    }
    bag.image("/camera/infra1/image_raw", depth_image(noisy_depth(32, 24, 1), "mono16", 3.0, 1));
  }
  const Error error = refusal(folder / "a.bag");
  EXPECT_EQ(error.code, ErrorCode::kInvalidOption);
  for (const char* word : {"--topic", "/camera/depth/image_raw", "aligned_depth_to_color"})
    EXPECT_NE(error.message.find(word), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find("infra1"), std::string::npos);
  ImportOptions options;
  options.topic = "/camera/depth/image_raw";
  EXPECT_EQ(open(folder / "a.bag", options)->frames().size(), 1u);
  options.topic = "/camera/colour/image_raw";
  EXPECT_NE(refusal(folder / "a.bag", options).message.find("infra1"), std::string::npos);
}

TEST(RosBag, AsksForACameraThatNobodyTells) {
  const TempFolder folder;
  {
    ReferenceBag bag((folder / "a.bag").string());
    bag.image("/depth/image", depth_image(noisy_depth(32, 24, 1), "16UC1", 3.0, 1));
  }
  const Error error = refusal(folder / "a.bag");
  EXPECT_EQ(error.code, ErrorCode::kMissingData);
  EXPECT_NE(error.message.find("--intrinsics"), std::string::npos);
  ImportOptions options;
  options.intrinsics = "40,41,16,12";
  const auto got = open(folder / "a.bag", options);
  EXPECT_EQ(got->header().sensors[0].intrinsics.width, 32);
  EXPECT_EQ(got->header().sensors[0].intrinsics.fy, 41.0);
}

TEST(RosBag, FindsTheColourCameraByTheTransforms) {
  const TempFolder folder;
  Pose T_link_depth = Pose::Identity(), T_link_color = Pose::Identity();
  T_link_depth.translation() = Vec3d(0.01, 0.02, 0.03);
  T_link_color.translation() = Vec3d(0.05, 0.0, 0.01);
  T_link_color.linear() = Eigen::AngleAxisd(0.3, Vec3d::UnitY()).toRotationMatrix();
  const ColorImage color = noisy_color(20, 10, 5);
  {
    ReferenceBag bag((folder / "a.bag").string());
    bag.frames("/tf_static", "link", "depth_optical", bag_pose(T_link_depth));
    bag.frames("/tf_static", "link", "color_optical", bag_pose(T_link_color));
    bag.camera("/d/camera_info", bag_camera(camera_of_size(32, 24)), "plumb_bob", "depth_optical");
    bag.camera("/c/camera_info", bag_camera(camera_of_size(20, 10)), "plumb_bob", "color_optical");
    for (unsigned i = 0; i < 3; ++i) {
      BagImage depth = depth_image(noisy_depth(32, 24, i), "16UC1", 3 + 0.1 * i, i);
      depth.frame_id = "depth_optical";
      bag.image("/d/image_raw", depth);
    }
    BagImage late = color_image(color, 3.11, 1);
    late.frame_id = "color_optical";
    late.encoding = "bgr8";
    bag.image("/c/image_raw", late);
  }
  const auto got = open(folder / "a.bag");
  const SensorInfo& sensor = got->header().sensors[0];
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_TRUE(sensor.T_color_sensor.isApprox(T_link_color.inverse() * T_link_depth, 1e-12));
  EXPECT_TRUE(frame_of(*got, 0).color.empty());  // 110 ms off
  const Frame matched = frame_of(*got, 1);
  ASSERT_EQ(matched.color.pixels.size(), color.pixels.size());
  EXPECT_EQ(matched.color.at(2, 3).r, color.at(2, 3).b);
  EXPECT_EQ(matched.color.at(2, 3).g, color.at(2, 3).g);
}

TEST(RosBag, TakesCompressedImages) {
  const TempFolder folder;
  const DepthImage depth = noisy_depth(32, 24, 3);
  const ColorImage color = noisy_color(32, 24, 3);
  {
    ReferenceBag bag((folder / "a.bag").string());
    bag.camera("/d/camera_info", bag_camera(camera_of_size(32, 24)), "plumb_bob", "f");
    BagImage image = depth_image(depth, "", 3.0, 1);
    image.frame_id = "f";
    image.pixels = std::string(12, '\0') + encode_depth_png(depth).value();
    bag.compressed("/d/image_raw/compressedDepth", image, "16UC1; compressedDepth png");
    image.pixels = encode_color_png(color).value();
    bag.compressed("/d/rgb/image_raw/compressed", image, "rgb8; png compressed bgr8");
    bag.camera("/d/rgb/camera_info", bag_camera(camera_of_size(32, 24)), "plumb_bob", "f");
  }
  const Frame frame = frame_of(*open(folder / "a.bag"), 0);
  EXPECT_EQ(frame.depth.pixels, without_65535(depth).pixels);
  EXPECT_EQ(frame.color.pixels, color.pixels);
}

TEST(RosBag, TimesTellWhatIsMissingWhereNumbersDoNot) {
  const TempFolder folder;
  {
    ReferenceBag bag((folder / "a.bag").string());
    bag.camera("/d/camera_info", bag_camera(camera_of_size(32, 24)), "plumb_bob");
    for (const int i : {0, 1, 2, 5, 6})
      bag.image("/d/image_raw", depth_image(noisy_depth(32, 24, 1), "16UC1", 3 + i / 30.0, 0));
  }
  const auto got = open(folder / "a.bag");
  ASSERT_EQ(got->frames().size(), 7u);
  EXPECT_EQ(got->frames()[3].status, FrameStatus::kDropped);
  EXPECT_EQ(got->frames()[4].status, FrameStatus::kDropped);
  EXPECT_NEAR(got->frames()[4].time_s, 4 / 30.0, 1e-8);
}

}  // namespace
}  // namespace turnscan
