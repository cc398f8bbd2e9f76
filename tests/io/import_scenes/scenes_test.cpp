// Scenes of nerfstudio and BOP.

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

/// x, y and z in the columns of the rotation: camera to world.
std::string nerfstudio_frame(int n, const std::string& more = "") {
  return fmt::format(
      R"({{"file_path": "./images/{0}.png", "depth_file_path": "depth/{0}.png", {1})"
      R"("transform_matrix": [[1, 0, 0, {0}], [0, 1, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]]}})",
      n, more);
}

std::string nerfstudio_scene(const std::string& frames, const std::string& more = "") {
  return fmt::format(
      R"({{"w": 8, "h": 6, "fl_x": 80, "fl_y": 82, "cx": 4.5, "cy": 3, "k1": 0.01, {} "frames": [{}]}})",
      more, frames);
}

/// Depth of 4 x 3 pixels, colour of 8 x 6.
void put_nerfstudio_images(const TempFolder& folder) {
  std::filesystem::create_directory(folder / "depth");
  std::filesystem::create_directory(folder / "images");
  for (int n = 0; n < 3; ++n) {
    put_depth(folder, fmt::format("depth/{}.png", n), std::uint16_t(700 + n));
    ASSERT_TRUE(write_color_png(folder / fmt::format("images/{}.png", n), ColorImage(8, 6)));
  }
}

TEST(Nerfstudio, ReadsPosesCamerasAndUnits) {
  const TempFolder folder;
  put_nerfstudio_images(folder);
  folder.put("transforms.json", nerfstudio_scene(nerfstudio_frame(0) + "," + nerfstudio_frame(1)));
  const auto sequence = open(folder.path());
  ASSERT_EQ(sequence->header().sensors.size(), 1u);
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.fx, 40.0);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.cx, 1.75);  // 4.5 / 2 from the corner
  EXPECT_DOUBLE_EQ(sensor.intrinsics.distortion[0], 0.01);
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_DOUBLE_EQ(sensor.color_intrinsics->cx, 4.0);
  const Frame frame = frame_of(*sequence, 1);
  EXPECT_EQ(frame.depth.at(1, 1), 701);
  EXPECT_EQ(frame.color.width, 8);
  // The camera looks along its world's -z, which is down; its up is the world's y.
  ASSERT_TRUE(frame.info.T_table_sensor);
  const Pose& pose = *frame.info.T_table_sensor;
  EXPECT_LT((pose * Vec3d(0, 0, 1) - Vec3d(1, -0.5, 0)).norm(), 1e-12);
  EXPECT_LT((pose.linear() * Vec3d(0, -1, 0) - Vec3d(0, 0, -1)).norm(), 1e-12);
}

TEST(Nerfstudio, FramesMayHaveCamerasOfTheirOwnAndNoDepth) {
  const TempFolder folder;
  put_nerfstudio_images(folder);
  folder.put("transforms.json",
             nerfstudio_scene(nerfstudio_frame(0) + "," + nerfstudio_frame(1, R"("fl_x": 90, )") +
                                  "," + nerfstudio_frame(2, R"("fl_x": 80.1, )") +
                                  R"(,{"file_path": "images/0.png"})",
                              R"("depth_unit_scale_factor": 0.0001, "applied_scale": 2,)"));
  const auto sequence = open(folder / "transforms.json");
  ASSERT_EQ(sequence->frames().size(), 3u);
  EXPECT_EQ(sequence->header().sensors.size(), 2u);
  EXPECT_EQ(sequence->frames()[1].sensor, 1u);
  EXPECT_EQ(sequence->frames()[2].sensor, 0u);
  EXPECT_EQ(sequence->header().sensors[1].depth_unit_m, 1e-4);
  EXPECT_NEAR(sequence->frames()[2].T_table_sensor->translation().x(), 1.0, 1e-12);
  EXPECT_THAT(sequence->header().source, HasSubstr("1 of 4 frames have no depth"));
}

TEST(Nerfstudio, WhatIsNotReadIsNamed) {
  const TempFolder folder;
  put_nerfstudio_images(folder);
  const auto why = [&](const std::string& text) {
    folder.put("transforms.json", text);
    return refusal(folder.path()).text();
  };
  EXPECT_THAT(why(nerfstudio_scene(R"({"file_path": "images/0.png"})")),
              HasSubstr("depth_file_path"));
  EXPECT_THAT(why(nerfstudio_scene(nerfstudio_frame(0), R"("camera_model": "OPENCV_FISHEYE",)")),
              HasSubstr("OPENCV_FISHEYE"));
  EXPECT_THAT(why(nerfstudio_scene(nerfstudio_frame(7))), HasSubstr("no such file"));
  EXPECT_THAT(why(nerfstudio_scene(nerfstudio_frame(0), R"("applied_scale": 0,)")),
              HasSubstr("applied_scale"));
  EXPECT_THAT(why(R"({"frames": [)" + nerfstudio_frame(0) + "]}"), HasSubstr("w is missing"));
  EXPECT_THAT(why("{"), HasSubstr("line 1"));
}

constexpr const char* kRotation = "[1, 0, 0, 0, 1, 0, 0, 0, 1]";

std::string bop_camera(const std::string& more = "") {
  return fmt::format(R"({{"cam_K": [80, 0, 1, 0, 81, 2, 0, 0, 1], "depth_scale": 0.1{}}})", more);
}

void put_bop_images(const TempFolder& folder) {
  std::filesystem::create_directory(folder / "depth");
  std::filesystem::create_directory(folder / "rgb");
  for (const int n : {2, 10}) put_depth(folder, fmt::format("depth/{:06}.png", n), 900);
  put_color(folder, "rgb/000010.png");
}

TEST(Bop, ReadsCamerasAndThePoseOfTheWorld) {
  const TempFolder folder;
  put_bop_images(folder);
  const std::string pose = fmt::format(R"(, "cam_R_w2c": {}, "cam_t_w2c": [0, 0, 500])", kRotation);
  folder.put("scene_camera.json", fmt::format(R"({{"10": {0}, "2": {0}}})", bop_camera(pose)));
  const auto sequence = open(folder.path());
  ASSERT_EQ(sequence->frames().size(), 2u);
  EXPECT_EQ(sequence->frames()[0].index, 2u);
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_DOUBLE_EQ(sensor.depth_unit_m, 1e-4);
  EXPECT_EQ(sensor.intrinsics.width, 4);
  EXPECT_EQ(sensor.intrinsics.cy, 2.0);
  EXPECT_EQ(frame_of(*sequence, 1).color.width, 4);
  EXPECT_NEAR(sequence->frames()[0].T_table_sensor->translation().z(), -0.5, 1e-12);
}

TEST(Bop, IsPlacedByItsOnlyObject) {
  const TempFolder folder;
  put_bop_images(folder);
  folder.put("scene_camera.json", fmt::format(R"({{"2": {0}, "10": {0}}})", bop_camera()));
  const std::string object =
      fmt::format(R"({{"cam_R_m2c": {}, "cam_t_m2c": [0, 0, 400], "obj_id": 5}})", kRotation);
  folder.put("scene_gt.json", fmt::format(R"({{"2": [{0}], "10": [{0}]}})", object));
  const auto sequence = open(folder.path());
  EXPECT_NEAR(sequence->frames()[1].T_table_sensor->translation().z(), -0.4, 1e-12);
  folder.put("scene_gt.json", fmt::format(R"({{"2": [{0}, {0}], "10": [{0}]}})", object));
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("shows 2 objects"));
  folder.put("scene_gt.json", fmt::format(R"({{"2": [{0}]}})", object));
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("no pose"));
}

TEST(Bop, WhatIsDamagedIsNamed) {
  const TempFolder folder;
  put_bop_images(folder);
  const auto why = [&](const std::string& text) {
    folder.put("scene_camera.json", text);
    return refusal(folder.path()).text();
  };
  EXPECT_THAT(why(R"({"x": {}})"), HasSubstr("scene_camera.json"));
  EXPECT_THAT(why("[]"), HasSubstr("scene_camera.json"));
  EXPECT_THAT(why("{}"), HasSubstr("no images"));
  EXPECT_THAT(why(R"({"2": {"cam_K": [1]}})"), HasSubstr("9"));
  EXPECT_THAT(why(R"({"2": )" + bop_camera(R"(, "depth_scale": 1e9)") + "}"),
              HasSubstr("depth_scale"));
}

}  // namespace
}  // namespace turnscan
