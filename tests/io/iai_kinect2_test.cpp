#include <gtest/gtest.h>

#include <filesystem>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/iai_kinect2.hpp>

#include "tests/io/temp_folder.hpp"
#include "tests/support/shared_data.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

TEST(IaiKinect2, ShiftIsInMillimetresAndAdded) {
  const TempFolder folder;
  ASSERT_TRUE(write_file_atomically(folder.path() / "calib_depth.yaml",
                                    std::string_view("%YAML:1.0\n---\ndepthShift: -2.5e+01\n")));
  const auto found = read_iai_kinect2(folder.path());
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_DOUBLE_EQ(found->depth_shift_m, -0.025);
  EXPECT_FALSE(found->intrinsics);
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
    if (!std::filesystem::exists(entry.path() / "calib_depth.yaml")) continue;
    const auto found = read_iai_kinect2(entry.path());
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_LT(std::abs(found->depth_shift_m), 0.07);
    ASSERT_TRUE(found->intrinsics);
    EXPECT_NEAR(found->intrinsics->fx, 365.0, 50.0);
    ++count;
  }
  EXPECT_GE(count, 5u);
}

}  // namespace
}  // namespace turnscan
