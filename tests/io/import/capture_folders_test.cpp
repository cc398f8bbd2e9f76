// Folders of images that 3D Scanner App and RTAB-Map export.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/import/foreign_data.hpp"

namespace turnscan {
namespace {

using testing::frame_of;
using ::testing::HasSubstr;
using testing::open;
using testing::put_color;
using testing::put_depth;
using testing::refusal;
using testing::TempFolder;

std::string app_json(int n, double x, double time) {
  return fmt::format(
      R"({{"cameraPoseARFrame": [1, 0, 0, {}, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],)"
      R"("intrinsics": [80, 0, 5, 0, 81, 4, 0, 0, 1], "time": {}, "frame_index": {}}})",
      x, time, n);
}

/// Depth of 4 x 3 pixels, colour of 8 x 6 for the first, confidence for the second.
void put_app_export(const TempFolder& folder, double step) {
  for (int n = 0; n < 4; ++n) {
    put_depth(folder, fmt::format("depth_0000{}.png", n), std::uint16_t(700 + n));
    folder.put(fmt::format("frame_0000{}.json", n), app_json(n, step * n, 50.0 + n / 10.0));
  }
  folder.put("frame_00007.json", "{}");  // has no depth: not read
  folder.put("info.json", "{}");
  ASSERT_TRUE(write_color_jpeg(folder / "frame_00000.jpg", ColorImage(8, 6, Rgb{9, 9, 9})));
  ColorImage levels(4, 3, Rgb{2, 2, 2});
  levels.at(1, 1) = Rgb{0, 0, 0};
  levels.at(2, 1) = Rgb{1, 1, 1};
  ASSERT_TRUE(write_color_png(folder / "conf_00001.png", levels));
}

TEST(ScannerApp, ReadsDepthColourCamerasTimesAndConfidence) {
  const TempFolder folder;
  put_app_export(folder, 0.0);
  const auto sequence = open(folder.path());
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.model, "iphone-lidar");
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.fx, 40.0);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.fy, 40.5);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.cx, 2.0);
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_DOUBLE_EQ(sensor.color_intrinsics->cx, 4.5);
  ASSERT_EQ(sequence->frames().size(), 4u);
  EXPECT_NEAR(sequence->frames()[3].time_s, 0.3, 1e-9);
  EXPECT_FALSE(sequence->frames()[0].T_table_sensor);
  EXPECT_EQ(frame_of(*sequence, 0).color.width, 8);
  const DepthImage depth = frame_of(*sequence, 1).depth;
  EXPECT_EQ(depth.at(1, 1), kNoReturn);
  EXPECT_EQ(depth.at(2, 1), 701);
  ImportOptions high;
  high.min_confidence = Confidence::kHigh;
  EXPECT_EQ(frame_of(*open(folder.path(), high), 1).depth.at(2, 1), kNoReturn);
}

TEST(ScannerApp, PosesOfAPhoneThatMovedPlaceTheFrames) {
  const TempFolder folder;
  put_app_export(folder, 0.1);
  const auto sequence = open(folder.path());
  ASSERT_TRUE(sequence->frames()[2].T_table_sensor);
  // ARKit's camera looks along -z, and up is y.
  EXPECT_LT((*sequence->frames()[2].T_table_sensor * Vec3d(0, 0, 1) - Vec3d(0.2, 0, -1)).norm(),
            1e-9);
}

TEST(ScannerApp, ADamagedDescriptionIsNamed) {
  const TempFolder folder;
  put_app_export(folder, 0.0);
  folder.put("frame_00002.json", R"({"intrinsics": [1, 2]})");
  const Error error = refusal(folder.path());
  EXPECT_EQ(error.code, ErrorCode::kFormat);
  EXPECT_THAT(error.text(), HasSubstr("frame_00002.json"));
  EXPECT_THAT(error.text(), HasSubstr("2 numbers"));
}

constexpr const char* kCalibration =
    "%YAML:1.0\n---\ncamera_name: \"1\"\nimage_width: 8\nimage_height: 6\n"
    "camera_matrix:\n   rows: 3\n   cols: 3\n   data: [ 99., 0., 4., 0., 99., 3., 0., 0., 1. ]\n"
    "projection_matrix:\n   rows: 3\n   cols: 4\n"
    "   data: [ 80., 0., 4.5, 0., 0., 82., 3., 0., 0., 0., 1., 0. ]\n";

/// Three frames, of which the pose of the second is missing.
void put_rtabmap_export(const TempFolder& folder, double step) {
  for (const char* name : {"scan_depth", "scan_rgb", "scan_calib"})
    std::filesystem::create_directory(folder / name);
  for (const int id : {2, 7, 10}) {
    put_depth(folder, fmt::format("scan_depth/{}.png", id), std::uint16_t(900 + id));
    ASSERT_TRUE(write_color_jpeg(folder / fmt::format("scan_rgb/{}.jpg", id),
                                 ColorImage(8, 6, Rgb{9, 9, 9})));
    folder.put(fmt::format("scan_calib/{}.yaml", id), kCalibration);
  }
  folder.put("scan_camera_poses.txt",
             fmt::format("#timestamp x y z qx qy qz qw id\n1600000000.5 {} 0 0 0 0 0 1 10\n"
                         "1600000000.0 0 0 0 0 0 0 1 2\n",
                         step));
}

TEST(RtabMap, ReadsDepthColourCameraAndPosesById) {
  const TempFolder folder;
  put_rtabmap_export(folder, 0.5);
  const auto sequence = open(folder.path());
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.fx, 40.0);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.cx, 2.25);
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_DOUBLE_EQ(sensor.color_intrinsics->fy, 82.0);
  ASSERT_EQ(sequence->frames().size(), 3u);
  EXPECT_EQ(sequence->frames()[1].status, FrameStatus::kDropped);
  ASSERT_TRUE(sequence->frames()[2].T_table_sensor);
  // In RTAB-Map's world z is up: the camera looks upwards there, and here along +y.
  EXPECT_LT(
      (sequence->frames()[2].T_table_sensor->linear() * Vec3d::UnitZ() - Vec3d::UnitY()).norm(),
      1e-9);
  const Frame frame = frame_of(*sequence, 2);
  EXPECT_EQ(frame.depth.at(1, 1), 910);
  EXPECT_EQ(frame.color.width, 8);
}

TEST(RtabMap, WithoutPosesAllFramesAreTaken) {
  const TempFolder folder;
  put_rtabmap_export(folder, 0.5);
  std::filesystem::remove(folder / "scan_camera_poses.txt");
  const auto sequence = open(folder.path());
  EXPECT_EQ(sequence->frames()[1].status, FrameStatus::kOk);
  EXPECT_THAT(sequence->header().source, HasSubstr("camera_poses.txt"));
  ImportOptions use;
  use.device_poses = DevicePoses::kUse;
  EXPECT_EQ(refusal(folder.path(), use).code, ErrorCode::kMissingData);
}

TEST(RtabMap, PosesInAnotherFormatAndAMissingCameraAreNamed) {
  const TempFolder folder;
  put_rtabmap_export(folder, 0.5);
  folder.put("scan_camera_poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("--poses_format 11"));
  put_rtabmap_export(folder, 0.5);
  folder.put("scan_calib/2.yaml", "%YAML:1.0\n");
  EXPECT_THAT(refusal(folder.path()).text(), HasSubstr("2.yaml"));
}

}  // namespace
}  // namespace turnscan
