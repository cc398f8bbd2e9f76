#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/import/iai_kinect2.hpp>

#include "tests/support/shared_data.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

TEST(IaiKinect2, ShiftIsInMillimetresAndAdded) {
  const TempFolder folder;
  ASSERT_TRUE(write_file_atomically(folder.path() / "calib_depth.yaml",
                                    std::string_view("%YAML:1.0\n---\ndepthShift: -2.5e+01\n")));
  const auto found = read_iai_kinect2(folder.path());
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_TRUE(found->depth);
  EXPECT_DOUBLE_EQ(found->depth->bias_m, -0.025);
  EXPECT_EQ(found->depth->scale, 1.0);
  EXPECT_FALSE(found->camera);
}

std::string camera_yaml(double fx, const std::string& distortion) {
  return fmt::format(
      "%YAML:1.0\ncameraMatrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ {}, "
      "0., 2.5e+02,\n       0., 366., 2.0e+02, 0., 0., 1. ]\ndistortionCoefficients: "
      "!!opencv-matrix\n   data: [ {} ]\nrotation: !!opencv-matrix\n   data: [ 1., 0. ]\n",
      fx, distortion);
}

TEST(IaiKinect2, BothCamerasAndThePlaceOfColourAreRead) {
  const TempFolder folder;
  folder.put("calib_ir.yaml", camera_yaml(365.5, "0.1, -0.2, 1e-3, -2e-3, 0.3"));
  folder.put("calib_color.yaml", camera_yaml(1060.25, "0., 0., 0., 0., 0., 0., 0., 0."));
  folder.put("calib_pose.yaml",
             "%YAML:1.0\nrotation: !!opencv-matrix\n   data: [ 0., -1., 0., 1., 0., 0., 0., 0., 1. "
             "]\ntranslation: !!opencv-matrix\n   data: [ -5.2e-02, 0., 1e-3 ]\n");
  const auto found = read_iai_kinect2(folder.path());
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_FALSE(found->depth);
  ASSERT_TRUE(found->camera);
  EXPECT_EQ(found->camera->intrinsics.fx, 365.5);
  EXPECT_EQ(found->camera->intrinsics.cy, 200.0);
  EXPECT_EQ(found->camera->intrinsics.width, 512);
  EXPECT_EQ(found->camera->intrinsics.distortion,
            (std::array<double, 8>{0.1, -0.2, 1e-3, -2e-3, 0.3}));
  ASSERT_TRUE(found->camera->color_intrinsics);
  EXPECT_EQ(found->camera->color_intrinsics->fx, 1060.25);
  EXPECT_EQ(found->camera->color_intrinsics->width, 1920);
  const Vec3d moved = found->camera->T_color_sensor * Vec3d(1.0, 0.0, 0.0);
  EXPECT_LT((moved - Vec3d(-0.052, 1.0, 0.001)).norm(), 1e-12);
}

TEST(IaiKinect2, EightCoefficientsAreTakenAndRotationsThatAreNoneAreRefused) {
  const TempFolder folder;
  folder.put("calib_ir.yaml", camera_yaml(365.5, "0.1, 0, 0, 0, 0, 0.2, 0, 0"));
  const auto rational = read_iai_kinect2(folder.path());
  ASSERT_TRUE(rational) << rational.error().text();
  EXPECT_EQ(rational->camera->intrinsics.distortion,
            (std::array<double, 8>{0.1, 0, 0, 0, 0, 0.2, 0, 0}));
  folder.put("calib_ir.yaml", camera_yaml(365.5, "0, 0, 0, 0, 0"));
  folder.put("calib_color.yaml", camera_yaml(1000.0, "0, 0, 0, 0, 0"));
  for (const char* pose :
       {"", "rotation: [ 1, 0, 0, 0, 2, 0, 0, 0, 1 ]\ntranslation: [ 0, 0, 0 ]\n",
        "rotation: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\ntranslation: [ 0, 0, 7 ]\n",
        "rotation: [ -1, 0, 0, 0, 1, 0, 0, 0, 1 ]\ntranslation: [ 0, 0, 0 ]\n"}) {
    folder.put("calib_pose.yaml", pose);
    const auto found = read_iai_kinect2(folder.path());
    ASSERT_FALSE(found) << pose;
    EXPECT_EQ(found.error().code, ErrorCode::kFormat);
    EXPECT_NE(found.error().path.find("calib_pose.yaml"), std::string::npos);
  }
}

TEST(IaiKinect2, DamagedFilesAreRefusedByName) {
  const TempFolder folder;
  EXPECT_EQ(read_iai_kinect2(folder.path()).error().code, ErrorCode::kNotFound);
  const auto depth = folder.path() / "calib_depth.yaml", ir = folder.path() / "calib_ir.yaml";
  for (const char* text : {"", "depthShift: x\n", "depthShift: 1e9\n", "depthShift: nan\n"}) {
    ASSERT_TRUE(write_file_atomically(depth, std::string_view(text)));
    const auto found = read_iai_kinect2(folder.path());
    ASSERT_FALSE(found) << text;
    EXPECT_EQ(found.error().code, ErrorCode::kFormat);
    EXPECT_NE(found.error().path.find("calib_depth.yaml"), std::string::npos);
  }
  ASSERT_TRUE(write_file_atomically(depth, std::string_view("depthShift: 1\n")));
  for (const char* text : {"", "cameraMatrix: data: [ 1, 2", "cameraMatrix: [ 1, 2, 3 ]"}) {
    ASSERT_TRUE(write_file_atomically(ir, std::string_view(text)));
    EXPECT_EQ(read_iai_kinect2(folder.path()).error().code, ErrorCode::kFormat) << text;
  }
}

TEST(IaiKinect2, ReadsTheCalibrationsOfRealSensors) {
  const auto data = testing::shared_data("kinect2/iai_kinect2_calib");
  TURNSCAN_NEEDS_DATA(data);
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data)) {
    const auto found = read_iai_kinect2(entry.path());
    ASSERT_TRUE(found) << found.error().text();
    if (found->depth) {
      EXPECT_LT(std::abs(found->depth->bias_m), 0.07);
    }
    if (!found->camera || !found->camera->color_intrinsics) continue;
    EXPECT_NEAR(found->camera->intrinsics.fx, 365.0, 50.0);
    EXPECT_NEAR(found->camera->color_intrinsics->fx, 1060.0, 50.0);
    // The colour camera lies 52 mm beside the depth camera; two of the calibrations are poor.
    EXPECT_NEAR(found->camera->T_color_sensor.translation().x(), -0.052, 0.016);
    ++count;
  }
  EXPECT_GE(count, 5u);
}

}  // namespace
}  // namespace turnscan
