// The driver for the Kinect v1 with colours, on a library that stands in for libfreenect.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <turnscan/capture/source/plugins.hpp>

#include "tests/capture/freenect/pattern.hpp"
#include "tests/capture/taking.hpp"

namespace turnscan {
namespace {

namespace pattern = testing::pattern;

/// In place of libfreenect, for the rest of the process: the loader takes the library that is there
/// already under that name.
bool load_stand_in() {
  static void* library = dlopen(TURNSCAN_FREENECT_STAND_IN, RTLD_NOW | RTLD_GLOBAL);
  return library != nullptr;
}

TEST(FreenectColor, ColoursComeWithTheDepthThatIsRegisteredToThem) {
  ASSERT_TRUE(load_stand_in()) << dlerror();
  const auto source = testing::opened("freenect:?color=1");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().identities,
            std::vector<std::string>{"freenect-kinect-v1-A00366A00000000A"});
  const SensorInfo& sensor = source->info().header.sensors[0];
  EXPECT_FALSE(sensor.color_intrinsics);  // on the depth image, pixel by pixel
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  EXPECT_EQ(sensor.intrinsics.fx, 525.0);  // as the colour camera sees it
  const testing::Taken taken = testing::run(*source);
  ASSERT_EQ(taken.frames.size(), pattern::kFrames);
  for (std::uint32_t f = 0; f < pattern::kFrames; ++f) {
    const Frame& frame = taken.frames[f];
    const auto depth = pattern::depth_mm(f);
    const auto colors = pattern::colors(f);
    ASSERT_EQ(frame.depth.pixels.size(), pattern::kPixels);
    ASSERT_EQ(frame.color.pixels.size(), pattern::kPixels);
    for (std::size_t i = 0; i < pattern::kPixels; ++i) {
      ASSERT_EQ(frame.depth.pixels[i], depth[i] >= 10000 ? 0 : depth[i]) << f << " " << i;
      const Rgb c = frame.color.pixels[i];
      ASSERT_TRUE(c.r == colors[3 * i] && c.g == colors[3 * i + 1] && c.b == colors[3 * i + 2]);
    }
    EXPECT_NEAR(frame.info.time_s, double(f) / 30.0, 1e-9);
  }
  ASSERT_TRUE(taken.error);
  EXPECT_EQ(taken.error->code, ErrorCode::kDeviceLost);
}

TEST(FreenectColor, WithoutThemDepthIsAsTheInfraredCameraSeesIt) {
  ASSERT_TRUE(load_stand_in()) << dlerror();
  const auto source = testing::opened("freenect:");
  ASSERT_TRUE(source);
  EXPECT_NEAR(source->info().header.sensors[0].intrinsics.fx, 575.8, 0.1);
  const testing::Taken taken = testing::run(*source);
  ASSERT_EQ(taken.frames.size(), pattern::kFrames);
  EXPECT_TRUE(taken.frames[0].color.empty());
}

TEST(FreenectColor, AreRefusedWhereNothingIsRegisteredToThem) {
  ASSERT_TRUE(load_stand_in()) << dlerror();
  const testing::Variable unregistered(pattern::kUnregistered, "1");
  const auto source = open_source("freenect:?color=1", {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(source.error().message.find("leave out color=1"), std::string::npos);
  EXPECT_TRUE(open_source("freenect:", {}));
}

}  // namespace
}  // namespace turnscan
