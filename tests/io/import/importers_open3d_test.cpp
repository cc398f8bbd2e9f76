// Folders of Open3D's recorders.

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

constexpr const char* kAzure =
    R"({"color_mode": "MJPG_720P", "depth_mode": "NFOV_UNBINNED", "height": 3,
        "intrinsic_matrix": [6.5, 0, 0, 0, 6.25, 0, 1.75, 1.5, 1], "serial_number": "1",
        "stream_length_usec": 1, "width": 4})";

void put_images(const TempFolder& folder) {
  std::filesystem::create_directory(folder / "depth");
  std::filesystem::create_directory(folder / "color");
  put_depth(folder, "depth/00000.png", 700);
  put_depth(folder, "depth/00003.png", 703);
  put_color(folder, "color/00000.png");
  folder.put("depth/notes.txt", "");
}

TEST(Open3dImport, ReadsWhatTheReaderOfAzureKinectRecordingsWrites) {
  const TempFolder folder;
  put_images(folder);
  folder.put("intrinsic.json", kAzure);
  folder.put("config.json", R"({"path_dataset": "x", "depth_scale": 1000.0})");
  ImportOptions options;
  options.fps = 15.0;
  const auto sequence = open(folder.path(), options);
  const SensorInfo& sensor = sequence->header().sensors.at(0);
  EXPECT_EQ(sensor.model, "azure-kinect");
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  EXPECT_EQ(sensor.intrinsics.fy, 6.25);
  EXPECT_EQ(sensor.intrinsics.cx, 1.75);
  EXPECT_EQ(sensor.intrinsics.cy, 1.5);
  ASSERT_EQ(sequence->frames().size(), 2u);
  EXPECT_EQ(sequence->frames()[1].index, 3u);
  EXPECT_DOUBLE_EQ(sequence->frames()[1].time_s, 0.2);
  EXPECT_EQ(frame_of(*sequence, 0).depth.at(1, 1), 700);
  EXPECT_EQ(frame_of(*sequence, 0).color.at(1, 1), (Rgb{1, 2, 3}));
  EXPECT_EQ(frame_of(*sequence, 1).depth.at(3, 2), kNoReturn);
  EXPECT_TRUE(frame_of(*sequence, 1).color.empty());
}

TEST(Open3dImport, TakesUnitRateAndModelOfARealSense) {
  const TempFolder folder;
  put_images(folder);
  folder.put("intrinsic.json",
             R"({"width": 4, "height": 3, "intrinsic_matrix": [6, 0, 0, 0, 6, 0, 2, 1, 1],
                 "depth_scale": 4000, "fps": 30, "device_name": "Intel RealSense D435I"})");
  const auto sequence = open(folder.path());
  EXPECT_EQ(sequence->header().sensors[0].model, "realsense-d435");
  EXPECT_EQ(sequence->header().sensors[0].depth_unit_m, 2.5e-4);
  EXPECT_DOUBLE_EQ(sequence->frames()[1].time_s, 0.1);
}

TEST(Open3dImport, AssumesMillimetresAndSaysSo) {
  const TempFolder folder;
  put_images(folder);
  folder.put("camera_intrinsic.json",
             R"({"width": 4, "height": 3, "intrinsic_matrix": [6, 0, 0, 0, 6, 0, 2, 1, 1]})");
  const auto sequence = open(folder.path());
  EXPECT_EQ(sequence->header().sensors[0].depth_unit_m, 1e-3);
  EXPECT_THAT(sequence->header().source, HasSubstr("as Open3D assumes"));
  EXPECT_THAT(sequence->header().source, HasSubstr("--fps"));
  EXPECT_TRUE(std::isnan(sequence->frames()[0].time_s));
}

TEST(Open3dImport, RefusesWhatMakesNoSense) {
  const TempFolder folder;
  put_images(folder);
  for (const char* text :
       {"", "{}", R"({"width": 4, "height": 3})",
        R"({"width": 4, "height": 3, "intrinsic_matrix": [6, 0, 2, 0, 6, 1, 0, 0, 1]})",
        R"({"width": 4, "height": 3, "intrinsic_matrix": [6, 0, 0, 0, 6, 0, 2, 1, 1],
            "depth_scale": 0})"}) {
    folder.put("intrinsic.json", text);
    const Error error = refusal(folder.path());
    EXPECT_EQ(error.code, ErrorCode::kFormat) << text;
    EXPECT_THAT(error.path, HasSubstr("intrinsic.json"));
  }
  folder.put("intrinsic.json", kAzure);
  put_color(folder, "depth/3.png");
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("same number"));
}

}  // namespace
}  // namespace turnscan
