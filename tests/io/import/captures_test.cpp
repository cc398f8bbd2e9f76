// Record3D and .sens. The files in data/ were written by Python's zipfile, zlib and struct after
// the published descriptions; depth and confidence were packed by the reference encoder of LZFSE,
// in lz4.r3d by liblz4 (frame 0 in the blocks of Apple's library, frame 1 as a frame).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/import/foreign_data.hpp"

namespace turnscan {
namespace {

using testing::frame_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::open;
using testing::refusal;
using testing::TempFolder;

std::filesystem::path data(std::string_view name) {
  return std::filesystem::path(TURNSCAN_IO_TESTS) / "import/data" / name;
}

ImportOptions with(DevicePoses poses, Confidence confidence = Confidence::kAuto) {
  ImportOptions options;
  options.device_poses = poses;
  options.min_confidence = confidence;
  return options;
}

/// Of frame n of the .r3d files, in steps of 0.1 mm.
int r3d_depth(int x, int y, int n) { return 5000 + 7 * x + 11 * y + 100 * n; }

TEST(Record3d, ReadsDepthColourTimesAndCameras) {
  const auto sequence = open(data("still.r3d"));
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.intrinsics.width, 24);
  EXPECT_EQ(sensor.intrinsics.height, 32);
  EXPECT_EQ(sensor.depth_unit_m, 1e-4);
  // The middle of 39, 39.5 ... 41 at half the size; from the corner to the centre of the pixel.
  EXPECT_DOUBLE_EQ(sensor.intrinsics.fx, 20.0);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.fy, 20.5);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.cx, 12.0);
  EXPECT_DOUBLE_EQ(sensor.intrinsics.cy, 15.0);
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_EQ(sensor.color_intrinsics->width, 48);
  EXPECT_DOUBLE_EQ(sensor.color_intrinsics->fx, 40.0);
  EXPECT_DOUBLE_EQ(sensor.color_intrinsics->cx, 24.5);
  EXPECT_TRUE(sensor.T_color_sensor.isApprox(Pose::Identity()));
  ASSERT_EQ(sequence->frames().size(), 6u);
  const Frame frame = frame_of(*sequence, 4);
  EXPECT_NEAR(frame.info.time_s, 0.4, 1e-9);
  EXPECT_EQ(frame.depth.at(5, 7), r3d_depth(5, 7, 3));
  EXPECT_EQ(frame.depth.at(23, 31), r3d_depth(23, 31, 3));
  EXPECT_EQ(frame.color.width, 48);
  EXPECT_NEAR(frame.color.at(20, 20).r, 200, 3);
  EXPECT_THAT(sequence->header().source, HasSubstr("focal length changed by 5.0 %"));
  EXPECT_THAT(sequence->header().source, HasSubstr("gaps are filled"));
}

TEST(Record3d, DepthAndConfidenceMayBePackedByLz4) {
  const auto sequence = open(data("lz4.r3d"), with(DevicePoses::kAuto, Confidence::kHigh));
  ASSERT_EQ(sequence->frames().size(), 2u);
  for (int n = 0; n < 2; ++n) {
    const DepthImage depth = frame_of(*sequence, std::size_t(n)).depth;
    ASSERT_EQ(depth.width, 24);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 24; ++x) ASSERT_EQ(depth.at(x, y), r3d_depth(x, y, n)) << n;
  }
}

TEST(Record3d, WhatIsNoDepthOrUnsureIsNoReturn) {
  const auto values = [](const ImportOptions& options) {
    const DepthImage depth = frame_of(*open(data("still.r3d"), options), 0).depth;
    return std::array{depth.at(0, 5), depth.at(1, 0), depth.at(2, 0),
                      depth.at(3, 5), depth.at(4, 5), depth.at(5, 5)};
  };
  const auto at = [](int x) { return std::uint16_t(r3d_depth(x, 5, 0)); };
  const std::uint16_t no = kNoReturn;
  using Row = std::array<std::uint16_t, 6>;
  // Nothing, not a number, beyond 6.55 m; confidence 0, 1 and 2.
  EXPECT_EQ(values({}), (Row{no, no, no, no, at(4), at(5)}));
  EXPECT_EQ(values(with(DevicePoses::kAuto, Confidence::kMedium)), values({}));
  EXPECT_EQ(values(with(DevicePoses::kAuto, Confidence::kLow)),
            (Row{no, no, no, at(3), at(4), at(5)}));
  EXPECT_EQ(values(with(DevicePoses::kAuto, Confidence::kHigh)), (Row{no, no, no, no, no, at(5)}));
}

TEST(Record3d, AGapInTheTimesIsADroppedFrame) {
  const auto sequence = open(data("still.r3d"));
  const FrameInfo& gap = sequence->frames()[3];
  EXPECT_EQ(gap.status, FrameStatus::kDropped);
  EXPECT_EQ(gap.index, 3u);
  EXPECT_NEAR(gap.time_s, 0.3, 1e-9);
  EXPECT_FALSE(sequence->read(3));
  EXPECT_THAT(sequence->header().source, HasSubstr("1 frames are missing by their times"));
}

TEST(Record3d, PosesOfAPhoneThatStandsStillAreIgnoredUnlessAskedFor) {
  const auto still = open(data("still.r3d"));
  EXPECT_FALSE(still->frames()[0].T_table_sensor);
  EXPECT_THAT(still->header().source, HasSubstr("the device stood still"));
  const auto used = open(data("still.r3d"), with(DevicePoses::kUse));
  EXPECT_TRUE(used->frames()[0].T_table_sensor);
  const auto moved = open(data("moved.r3d"));
  EXPECT_THAT(moved->header().source, HasSubstr("the device moved"));
  EXPECT_FALSE(open(data("moved.r3d"), with(DevicePoses::kIgnore))->frames()[0].T_table_sensor);
}

TEST(Record3d, PosesMapFromOpenGlsCameraFrame) {
  const auto sequence = open(data("moved.r3d"));
  ASSERT_EQ(sequence->frames().size(), 4u);
  ASSERT_TRUE(sequence->frames()[2].T_table_sensor);
  // Turned to the left by 90 degrees: 1 m ahead is at -x, 1 m down stays down.
  const Pose& pose = *sequence->frames()[2].T_table_sensor;
  EXPECT_LT((pose * Vec3d(0, 0, 1) - Vec3d(-0.8, 0.2, 0.3)).norm(), 1e-9);
  EXPECT_LT((pose * Vec3d(0, 1, 0) - Vec3d(0.2, -0.8, 0.3)).norm(), 1e-9);
  // A pose of zeros is none.
  EXPECT_EQ(sequence->frames()[3].status, FrameStatus::kDropped);
}

TEST(Record3d, DepthOfColoursSizeIsTakenForTrueDepthAndIsRegistered) {
  const auto sequence = open(data("moved.r3d"));
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.model, "iphone-truedepth");
  EXPECT_EQ(sensor.intrinsics.width, 48);
  EXPECT_FALSE(sensor.color_intrinsics);
  EXPECT_EQ(frame_of(*sequence, 1).depth.at(9, 9), r3d_depth(9, 9, 1));
  EXPECT_EQ(open(data("still.r3d"))->header().sensors[0].model, "iphone-lidar");
}

TEST(Record3d, AnOptionOfAnotherLayoutIsRefused) {
  ImportOptions options;
  options.depth_unit_m = 1e-3;
  EXPECT_EQ(refusal(data("still.r3d"), options).code, ErrorCode::kInvalidOption);
  EXPECT_EQ(refusal(data("moved.sens"), with(DevicePoses::kAuto, Confidence::kLow)).code,
            ErrorCode::kInvalidOption);
}

TEST(Sens, ReadsDepthColourTimesAndCameras) {
  const auto sequence = open(data("moved.sens"));
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.model, "StructureTest");
  EXPECT_NEAR(sensor.depth_unit_m, 1e-3, 1e-12);
  EXPECT_EQ(sensor.intrinsics.width, 24);
  EXPECT_EQ(sensor.intrinsics.fx, 25.0);
  EXPECT_EQ(sensor.intrinsics.cy, 8.0);
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_EQ(sensor.color_intrinsics->fy, 51.0);
  EXPECT_LT((sensor.T_color_sensor.translation() - Vec3d(0.02, 0, 0)).norm(), 1e-7);
  const Frame frame = frame_of(*sequence, 1);
  EXPECT_EQ(frame.depth.at(0, 3), kNoReturn);
  EXPECT_EQ(frame.depth.at(1, 3), kNoReturn);
  EXPECT_EQ(frame.depth.at(5, 3), 700 + 5 + 9 + 10);
  EXPECT_NEAR(frame.info.time_s, 0.033333, 1e-9);
  EXPECT_NEAR(frame.color.at(20, 20).g, 100, 3);
  const std::string file = ::turnscan::testing::content_of(data("moved.sens"));
  EXPECT_FALSE(frame.color_jpeg.empty());
  EXPECT_NE(file.find(frame.color_jpeg), std::string::npos) << "byte for byte";
}

TEST(Sens, FramesWithoutAPoseAndGapsAreDropped) {
  const auto sequence = open(data("moved.sens"));
  ASSERT_EQ(sequence->frames().size(), 5u);
  EXPECT_EQ(sequence->frames()[2].status, FrameStatus::kDropped);  // -inf: tracking was lost
  EXPECT_EQ(sequence->frames()[3].status, FrameStatus::kDropped);  // by the times
  ASSERT_TRUE(sequence->frames()[4].T_table_sensor);
  EXPECT_NEAR(sequence->frames()[4].T_table_sensor->translation().x(), 0.32, 1e-6);
}

TEST(Sens, ReadsStoredImagesAndIgnoresPosesOfOneThatStandsStill) {
  const auto sequence = open(data("still-raw.sens"));
  EXPECT_FALSE(sequence->frames()[1].T_table_sensor);
  const Frame frame = frame_of(*sequence, 2);
  EXPECT_EQ(frame.depth.at(5, 3), 700 + 5 + 9 + 20);
  EXPECT_EQ(frame.color.at(3, 3), (Rgb{200, 100, 20}));
}

/// Opens it, reads all frames; the number of those that are whole.
std::size_t whole_frames(const std::filesystem::path& path) {
  const auto sequence = open_foreign(path, {});
  if (!sequence) {
    EXPECT_FALSE(sequence.error().message.empty());
    EXPECT_EQ(sequence.error().message.find('\n'), std::string::npos);
    EXPECT_THAT(sequence.error().text(), HasSubstr(path.filename().string()));
    return 0;
  }
  std::size_t whole = 0;
  for (std::size_t i = 0; i < (*sequence)->frames().size(); ++i)
    whole += (*sequence)->read(i) ? 1 : 0;
  return whole;
}

class Damage : public ::testing::TestWithParam<const char*> {};

TEST_P(Damage, AFileThatIsCutOffOpensAsFarAsItIsWhole) {
  const TempFolder folder;
  const std::string bytes = testing::content_of(data(GetParam()));
  const std::size_t all = whole_frames(data(GetParam()));
  std::size_t before = 0;
  for (std::size_t part = 0; part < 50; ++part) {
    const std::size_t whole = whole_frames(
        folder.put(std::string("cut-") + GetParam(), bytes.substr(0, bytes.size() * part / 50)));
    EXPECT_LE(whole, all);
    EXPECT_GE(whole, before) << part;
    before = whole;
  }
  EXPECT_GE(before + 1, all);
}

TEST_P(Damage, FlippedBitsGiveAnErrorOrFrames) {
  const TempFolder folder;
  const std::string bytes = testing::content_of(data(GetParam()));
  for (std::size_t bit = 0; bit < bytes.size() * 8; bit += bytes.size() * 8 / 60) {
    std::string damaged = bytes;
    damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << bit % 8));
    (void)whole_frames(folder.put(std::string("flipped-") + GetParam(), damaged));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Captures, Damage, ::testing::Values("still.r3d", "moved.r3d", "moved.sens", "still-raw.sens"),
    [](const auto& param) {
      std::string name = param.param;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
      return name;
    });

TEST(Captures, ACutFileSaysHowManyFramesItHas) {
  const TempFolder folder;
  const std::string r3d = testing::content_of(data("still.r3d"));
  const auto sequence = open(folder.put("cut.r3d", r3d.substr(0, r3d.size() * 6 / 10)));
  EXPECT_THAT(sequence->header().source, HasSubstr("cut off"));
  EXPECT_THAT(sequence->header().source, HasSubstr(" of 5 are whole"));
  const std::string sens = testing::content_of(data("moved.sens"));
  EXPECT_THAT(open(folder.put("cut.sens", sens.substr(0, sens.size() / 2)))->header().source,
              HasSubstr(" of 4 are whole"));
}

TEST(Captures, OtherFilesAreRefusedWithTheReason) {
  const TempFolder folder;
  EXPECT_EQ(refusal(folder.put("x.bin", "something else")).code, ErrorCode::kUnsupported);
  ImportOptions options;
  options.format = ImportFormat::kRecord3d;
  EXPECT_THAT(refusal(folder.put("x.r3d", "something else"), options).message,
              HasSubstr("no zip archive"));
  options.format = ImportFormat::kSens;
  EXPECT_THAT(refusal(folder.put("x.sens", "something else"), options).message,
              HasSubstr("version"));
}

}  // namespace
}  // namespace turnscan
