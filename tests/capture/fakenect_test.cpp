// The driver for the Kinect v1 as it is, on libfreenect's own stand-in for the hardware.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <turnscan/capture/plugins.hpp>

#include "tests/capture/fakenect_dump.hpp"
#include "tests/capture/taking.hpp"
#include "tests/io/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::DumpWriter;
using testing::opened;
using testing::Taken;
using testing::TempFolder;
using testing::Variable;

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

/// fakenect in place of libfreenect, for the rest of the process: the loader takes the library that
/// is there already under that name.
bool load_fakenect() {
  static void* library = dlopen(TURNSCAN_FAKENECT, RTLD_NOW | RTLD_GLOBAL);
  return library != nullptr;
}

TEST(Freenect, AVirtualKinectsDumpComesBackBitByBit) {
  ASSERT_TRUE(load_fakenect()) << dlerror();
  const TempFolder folder;
  const auto sensor = opened("virtual:cylinder?frames=3&turns=0.1&noise=gaussian:1mm&sensor=" +
                             testing::kinect_v1_file(folder.path()).string());
  ASSERT_TRUE(sensor);
  const Taken direct = testing::run(*sensor);
  ASSERT_EQ(direct.frames.size(), 3u);
  DumpWriter dump(folder / "dump");
  // The clock of 32 bits runs over between the frames.
  std::uint32_t ticks = 0xffffff00U;
  for (const Frame& frame : direct.frames) {
    dump.add(frame.depth, ticks);
    ticks += 2000000U;
  }
  const Variable path("FAKENECT_PATH", (folder / "dump").string());
  const auto source = opened("freenect:0");
  ASSERT_TRUE(source);
  EXPECT_TRUE(source->info().live);
  EXPECT_EQ(source->info().identities, std::vector<std::string>{"freenect-kinect-v1-0"});
  const CameraIntrinsics& camera = source->info().header.sensors[0].intrinsics;
  const CameraIntrinsics& truth = sensor->info().header.sensors[0].intrinsics;
  EXPECT_EQ(camera.width, truth.width);
  EXPECT_NEAR(camera.fx, truth.fx, 1e-5);
  EXPECT_EQ(camera.cx, truth.cx);
  EXPECT_EQ(source->info().header.sensors[0].depth_unit_m,
            sensor->info().header.sensors[0].depth_unit_m);
  ASSERT_TRUE(source->start());
  const Taken taken = testing::take_all(*source, 3);
  ASSERT_EQ(taken.frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(taken.frames[i].depth.pixels,
              testing::rounded_as_kinect(direct.frames[i].depth).pixels);
    EXPECT_NEAR(taken.frames[i].info.time_s, double(i) / 30.0, 1e-9);
  }
  // A dump that ends is a Kinect that was unplugged.
  const auto gone = source->next(20.0, {});
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().code, ErrorCode::kDeviceLost);
  EXPECT_NE(gone.error().message.find("cable"), std::string::npos);
}

TEST(Freenect, ADeviceThatIsNotThereIsNotFound) {
  ASSERT_TRUE(load_fakenect()) << dlerror();
  const auto source = open_source("freenect:7", {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(open_source("freenect:0?color=yes", {}).error().code, ErrorCode::kInvalidOption);
}

#endif

}  // namespace
}  // namespace turnscan
