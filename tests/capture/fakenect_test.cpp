// The driver for the Kinect v1 as it is, on libfreenect's own stand-in for the hardware.

#include <gtest/gtest.h>

#include <turnscan/capture/source/plugins.hpp>

#include "tests/capture/fakenect_doll.hpp"
#include "tests/capture/fakenect_dump.hpp"

namespace turnscan {
namespace {

using testing::kFakenectFrames;
using testing::load_fakenect;

TEST(KinectV1, TheTableRisesAndItsInverseFindsTheNearestValue) {
  const auto table = plugin::KinectV1().table();
  for (std::size_t raw = 401; raw < 1000; ++raw) EXPECT_GT(table[raw], table[raw - 1]);
  EXPECT_EQ(table[2047], 0);
  // The reference plane itself: no shift but the constant one.
  EXPECT_NEAR(plugin::KinectV1().depth_m(801), 1.2, 0.003);
  const auto raw = testing::raw_values();
  for (std::uint32_t depth = 5000; depth < 30000; depth += 7) {
    const std::uint16_t r = raw[depth];
    for (const int other : {r - 1, r + 1})
      EXPECT_LE(std::abs(int(table[r]) - int(depth)),
                std::abs(int(table[std::size_t(other)]) - int(depth)));
  }
  EXPECT_EQ(raw[0], plugin::KinectV1::kNoValue);
}

#ifdef TURNSCAN_FAKENECT

using Freenect = testing::FakenectDoll;

TEST_F(Freenect, AVirtualKinectsDumpComesBackBitByBit) {
  EXPECT_TRUE(kinect.live);
  EXPECT_EQ(kinect.identities, std::vector<std::string>{"freenect-kinect-v1-0"});
  const CameraIntrinsics& camera = kinect.header.sensors[0].intrinsics;
  const CameraIntrinsics& truth = rig.header.sensors[0].intrinsics;
  EXPECT_EQ(camera.width, truth.width);
  EXPECT_EQ(camera.fx, truth.fx);
  EXPECT_EQ(camera.cx, truth.cx);
  EXPECT_EQ(kinect.header.sensors[0].depth_unit_m, rig.header.sensors[0].depth_unit_m);
  ASSERT_EQ(taken.size(), kFakenectFrames);
  for (std::size_t i = 0; i < kFakenectFrames; ++i) {
    EXPECT_EQ(taken[i].depth.pixels, testing::rounded_as_kinect(direct[i].depth).pixels);
    EXPECT_NEAR(taken[i].info.time_s, double(i) / 30.0, 1e-9);
  }
  // A dump that ends is a Kinect that was unplugged.
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->code, ErrorCode::kDeviceLost);
  EXPECT_NE(ending->message.find("cable"), std::string::npos);
}

TEST(FreenectAddress, OfADeviceThatIsNotThereIsNotFound) {
  ASSERT_TRUE(load_fakenect()) << dlerror();
  const auto source = open_source("freenect:7", {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(open_source("freenect:0?color=yes", {}).error().code, ErrorCode::kInvalidOption);
}

#endif

}  // namespace
}  // namespace turnscan
