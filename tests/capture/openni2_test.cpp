// The driver for OpenNI 2 as it is, on the dummy device that OpenNI brings.

#include <gtest/gtest.h>

#ifdef TURNSCAN_OPENNI2

#include <turnscan/capture/plugins.hpp>

#include "tests/capture/taking.hpp"
#include "tests/io/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::opened;
using testing::Taken;
using testing::TempFolder;

/// The dummy's first line is two metres away; below it moves a ball of a known slope.
void expect_dummy(const Frame& frame) {
  ASSERT_EQ(frame.info.status, FrameStatus::kOk);
  for (int x = 0; x < 320; ++x) EXPECT_EQ(frame.depth.at(x, 0), 2000);
  int ball = 0;
  for (int y = 1; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      if (frame.depth.at(x, y) == 0) continue;
      // 1000 + 3 (x - y), about the ball's middle, which moves on the image's diagonal.
      EXPECT_NEAR(frame.depth.at(x, y), 1000, 3 * 320);
      ++ball;
    }
  EXPECT_GT(ball, 20);
}

TEST(OpenNi2, TakesFramesFromTheDummyDevice) {
  const auto source = opened("openni2:Dummy?hfov=58");
  ASSERT_TRUE(source);
  const SourceInfo& info = source->info();
  EXPECT_TRUE(info.live);
  EXPECT_EQ(info.fps, 30.0);
  EXPECT_EQ(info.header.sensors[0].depth_unit_m, 1e-3);
  EXPECT_EQ(info.header.sensors[0].intrinsics.width, 320);
  EXPECT_NEAR(info.header.sensors[0].intrinsics.fx, 288.647, 1e-3);
  ASSERT_TRUE(source->start());
  const Taken taken = testing::take_all(*source, 4);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 4u);
  double last_s = 0.0;
  for (const Frame& frame : taken.frames) {
    if (frame.info.status == FrameStatus::kDropped) continue;  // a slow machine
    expect_dummy(frame);
    EXPECT_GT(frame.info.time_s, last_s);
    last_s = frame.info.time_s;
  }
}

TEST(OpenNi2, SaysWhatItNeedsOrWhatIsNotThere) {
  const TempFolder folder;
  const auto narrow = open_source("openni2:Dummy", {});
  ASSERT_FALSE(narrow);
  EXPECT_EQ(narrow.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(narrow.error().message.find("hfov=DEGREES"), std::string::npos);
  EXPECT_EQ(open_source("openni2:nowhere.oni", {}).error().code, ErrorCode::kNotFound);
  const std::string damaged = folder.put("damaged.oni", "this is no film").string();
  EXPECT_EQ(open_source("openni2:" + damaged, {}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(open_source("openni2:Dummy?hfov=200", {}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(open_source("openni2:Dummy?hfov=58&color=1", {}).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(open_source("openni2:Dummy?hfov=58&mode=1x1@1", {}).error().code,
            ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan

#endif
